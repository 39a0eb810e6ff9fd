#pragma once

#include <cstdint>

#include "seedflow/base/vector.h"

namespace seedflow {

/// What a dragged body (one sub-sphere, or one whole seed) sees of the air around it. SI units, lab frame.
struct FlowAtBody {
  std::int64_t body = 0;   ///< identity of the body, the same for its whole life; keys the memory of effects
  double time = 0;         ///< at the start of the step [s]; effects with memory advance when it grows
  double time_step = 0;    ///< [s] of the air step this force is held over
  double diameter = 0;     ///< volume-equivalent diameter of the body [m]
  double volume = 0;       ///< buoyant volume [m3]
  double mass = 0;         ///< [kg]
  double sphericity = 1;   ///< surface of the equal-volume sphere / surface of the body
  Vec3 position;           ///< [m]
  Vec3 velocity;           ///< of the body [m/s]
  Vec3 angular_velocity;   ///< of the body [rad/s]
  Vec3 acceleration;       ///< of the body over the last step [m/s2]
  Vec3 flow_velocity;      ///< (undisturbed where the coupling corrects it) [m/s]
  Vec3 flow_vorticity;     ///< curl u [1/s]
  Vec3 flow_acceleration;  ///< Du/Dt [m/s2]
  /// laplace u [1/(m s)]; left zero where the velocity is already an average over the body, which holds it.
  Vec3 flow_laplacian;
  Vec3 pressure_gradient;        ///< of the dynamic pressure, hydrostatic part excluded [Pa/m]
  double void_fraction = 1;      ///< eps of the air at the body
  double density = 1.2;          ///< of the air [kg/m3]
  double viscosity = 1.8e-5;     ///< dynamic, of the air [Pa s]
  Vec3 gravity;                  ///< [m/s2]
  double wall_distance = 1e300;  ///< from the centre to the nearest wall [m]
  Vec3 wall_normal;              ///< unit, from the nearest wall to the body; zero where there is no wall
  double tube_diameter = 1e300;  ///< of the confining vessel [m]
};

/// What the effects answer. The force on the body is
///   F = drag_coefficient (flow_velocity - velocity) + force - added_mass * d velocity/dt,
/// the first and last term being treated implicitly by whoever integrates.
struct BodyForce {
  double drag_coefficient = 0;  ///< [kg/s]
  Vec3 force;                   ///< [N]
  Vec3 torque;                  ///< [N m]
  double added_mass = 0;        ///< [kg]
};

inline Vec3 slip(const FlowAtBody& f) {
  return f.flow_velocity - f.velocity;
}
/// Reynolds number of the slip on the superficial velocity, eps rho d |u - v| / mu.
inline double reynolds(const FlowAtBody& f) {
  return f.void_fraction * f.density * f.diameter * norm(slip(f)) / f.viscosity;
}

}  // namespace seedflow
