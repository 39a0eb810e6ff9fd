#pragma once

#include <iosfwd>
#include <vector>

#include "seedflow/coupling/bodies.h"
#include "seedflow/effects/catalogue.h"

namespace seedflow {

/// What the air is at the bodies, one entry per body, already averaged with the exchange weights (or
/// evaluated at the centre in a prescribed flow).
struct AirAtBodies {
  std::vector<Vec3> velocity;           ///< [m/s]
  std::vector<Vec3> vorticity;          ///< [1/s]
  std::vector<Vec3> acceleration;       ///< Du/Dt [m/s2]
  std::vector<Vec3> pressure_gradient;  ///< [Pa/m]
  std::vector<double> void_fraction;    ///< [1]
};

/// The properties of the fluid that do not vary in space.
struct AirProperties {
  double density = 1000;    ///< [kg/m3]
  double viscosity = 0.01;  ///< dynamic [Pa s]
  bool pressure_shared =
      true;  ///< model A: the seeds bear their share of the pressure gradient; false: model B
};

/// From the air at the bodies to the forces on them: asks every effect of the run.
///
/// A drag law wants the air as if the body were absent. With the Gaussian exchange kernel the body's own
/// disturbance is removed before any effect sees the air (effects/regularised_disturbance.h), <u> averaged, u
/// undisturbed:
///   steady      u - v = (<u> - v) / (1 + eps_p / 3 - k M / (mu s)),  k the drag coefficient at u - v,
///   transient   u - v = (<u> - u' - v) / (1 + eps_p / 3),  u' from the record of forces and path.
/// k is that of the last step: at a steady speed the equation is met, and every step needs one evaluation.
class BodyLoads {
 public:
  BodyLoads(EffectSet& effects, const AirProperties& air, const Vec3& gravity)
      : effects(effects), air(air), gravity(gravity) {}

  /// \param kernel_width standard deviation of the Gaussian [m]; `displacement`: whether the void fraction,
  /// spread by the same Gaussian, moves the air too.
  /// `with_memory`: the transient disturbance, else the steady one.
  void remove_self_disturbance(double kernel_width, bool displacement, bool with_memory) {
    sigma = kernel_width;
    displaces = displacement;
    transient = with_memory;
  }
  /// What the air received from each body during the last step [N]; for the transient disturbance.
  void remember(const std::vector<Vec3>& force_on_air) { given = force_on_air; }
  void confine(double vessel_diameter) { tube = vessel_diameter; }

  /// Fills force[b] for every body: the drag coefficient refers to the averaged (disturbed) velocity, so that
  /// force = k (<u> - v) + force is what the body feels.
  void evaluate(const Bodies& bodies, const AirAtBodies& flow, const Dem& dem, double time, double time_step);

  std::vector<BodyForce> force;
  /// The part of force[b].force that is the hydrostatic buoyancy, -strength rho V g: the one force of the
  /// fluid that is not exchanged with the moving air [N].
  std::vector<Vec3> hydrostatic;

  /// Strength of the dynamic pressure's force on the bodies (0 in model B).
  double pressure_gradient_strength() const;

  void save(std::ostream& out) const;
  void load(std::istream& in);

 private:
  /// Undisturbed over averaged slip.
  double slip_amplification(double own_share, double drag, double slip_speed) const;
  /// Velocity that body b has given to the air where it is now, by its record up to `time` [m/s].
  Vec3 induced_velocity(std::size_t b, const Vec3& velocity, double time);

  EffectSet& effects;
  AirProperties air;
  Vec3 gravity;
  double sigma = 0, tube = 1e300;
  bool displaces = false, transient = false;
  std::vector<double> last_drag;    ///< k of the laws at the last step, for the self-disturbance [kg/s]
  std::vector<double> last_slip;    ///< undisturbed slip of the last step [m/s]
  std::vector<Vec3> last_velocity;  ///< for the acceleration [m/s]
  std::vector<Vec3> given;          ///< to the air during the last step [N]
  std::vector<Vec3> path;           ///< in a frame that moves with the undisturbed air [m]
  std::vector<Vec3> last_air;       ///< undisturbed velocity of the air at the last step [m/s]
  std::vector<std::vector<double>> record;  ///< of TransientSelfVelocity
  double last_time = 0;
};

}  // namespace seedflow
