#pragma once

#include <string>

namespace seedflow {

class Parameters;

/// Elastic material of seeds and walls.
struct Material {
  std::string name;
  double density = 1340;         ///< [kg/m3]
  double poisson_ratio = 0.4;    ///< [1]
  double shear_modulus = 1.5e8;  ///< G [Pa]; Young's modulus is 2 G (1 + nu)

  /// Inside a section of the caller's.
  void declare(Parameters& parameters);
};

struct ContactStrengths;

/// What belongs to a pair of materials. Defaults: the source paper's Table 3, seed on seed.
struct ContactProperties {
  double restitution = 0.526;      ///< coefficient of restitution e [1], in (0, 1]
  double static_friction = 0.297;  ///< Coulomb coefficient mu [1]
  double rolling_friction = 0.03;  ///< coefficient of rolling friction mu_r [1]

  std::string tangential_model = "Mindlin without slip";  ///< or Mindlin with partial slip
  double partial_slip = 1;                                ///< strength of the partial slip in [0, 1]
  double speed_dependence = 1;  ///< share of viscoelastic damping in [0, 1], if the restitution law is that

  std::string rolling_model = "constant torque";  ///< none | constant torque | EPSD
  double rolling_damping = 0.3;                   ///< damping ratio eta of EPSD [1]
  double mobilised_damping = 0;                   ///< part of EPSD's dashpot left at full mobilisation [1]

  /// constant: e at every speed. viscoelastic: e holds at one speed for one body, and falls with the speed.
  std::string restitution_law = "constant";
  double restitution_speed = 1;                    ///< impact speed at which e was measured [m/s]
  double restitution_diameter = 4e-3;              ///< of the sphere it was measured with [m]
  std::string restitution_counterpart = "sphere";  ///< sphere (another of the same size) | plane

  std::string cohesion = "none";  ///< none | JKR | capillary bridge | by strength
  double surface_energy = 0;      ///< JKR: work of adhesion of the two surfaces w [J/m2]
  double surface_tension = 0;     ///< of the bridge's liquid [N/m]
  double contact_angle = 0;       ///< of the liquid on both bodies [rad]
  double bridge_volume = 0;       ///< liquid in one bridge [m3]

  /// The same with the effects of contacts weakened; an effect of strength 0 is off.
  ContactProperties weakened(const ContactStrengths& strengths) const;

  /// Inside a section of the caller's.
  void declare(Parameters& parameters);
  /// Throws InputError, beginning with `where`, if a value is not allowed, a model lacks what it needs, or
  /// something is given that the chosen models do not use.
  void check(const std::string& where) const;
};

}  // namespace seedflow
