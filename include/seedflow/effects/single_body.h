#pragma once

#include <functional>
#include <vector>

#include "seedflow/effects/catalogue.h"

namespace seedflow {

/// A plane wall: a point on it and the unit normal into the fluid.
struct WallPlane {
  Vec3 point, normal;
};

/// A flow known beforehand, which the body does not change (one-way). Its derivatives are taken numerically.
struct PrescribedFlow {
  std::function<Vec3(const Vec3& position, double time)> velocity;  ///< [m/s]; empty: fluid at rest
  double density = 1000;                                            ///< [kg/m3]
  double viscosity = 1e-3;                                          ///< dynamic [Pa s]
  Vec3 gravity = {0, 0, -9.81};                                     ///< [m/s2]
  double void_fraction = 1;
  double tube_diameter = 1e300;  ///< [m]
  std::vector<WallPlane> walls;
};

/// A rigid sphere, or a body described by its volume-equivalent sphere.
struct SingleBodyProperties {
  double diameter = 1e-3;  ///< [m]
  double density = 2500;   ///< [kg/m3]
  double sphericity = 1;
};

struct SingleBodyState {
  double time = 0;        ///< [s]
  Vec3 position;          ///< [m]
  Vec3 velocity;          ///< [m/s]
  Vec3 angular_velocity;  ///< [rad/s]
  Vec3 acceleration;      ///< mean over the last step [m/s2]
};

/// One body moving through a prescribed flow under the effects of a set, its weight, and nothing else:
///
///   (m + M_a) dv/dt = m g + k (u - v) + F,      I domega/dt = T,      I = m d^2/10.
///
/// Exponential midpoint rule: k, F, M_a and u are taken in the middle of the step, the resulting linear
/// equation is solved exactly, so the scheme is of second order and stable for any k dt/m (drag and added
/// mass implicit).
///
/// Undisturbed stresses: the effects are given grad p_d = -rho Du/Dt (the viscous part of the undisturbed
/// stress included). Source: Maxey & Riley (1983), doi:10.1063/1.864230.
///
/// Errors: InputError for non-positive properties or steps; RunError if the state stops being finite.
class SingleBody {
 public:
  /// The flow and the effects belong to the caller and must outlive the object.
  SingleBody(const SingleBodyProperties& properties, const PrescribedFlow& flow, EffectSet& effects,
             const SingleBodyState& start = {});

  const SingleBodyState& state() const { return now; }
  double mass() const { return body_mass; }

  /// What the body would tell the effects at this place and time; `step` is the step about to be taken [s].
  FlowAtBody flow_at(const SingleBodyState& state, double time, double step) const;

  void step(double dt);
  /// Steps of at most dt to the given rising times, and the states there.
  std::vector<SingleBodyState> run(const std::vector<double>& times, double dt);

 private:
  SingleBodyProperties properties;
  const PrescribedFlow& flow;
  EffectSet& effects;
  SingleBodyState now;
  double body_mass, inertia;
};

}  // namespace seedflow
