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

/// What belongs to a pair of materials (the source paper's Table 3).
struct ContactProperties {
  double restitution = 0.526;      ///< coefficient of restitution e [1], in (0, 1]
  double static_friction = 0.297;  ///< Coulomb coefficient mu [1]
  double rolling_friction = 0.03;  ///< coefficient of rolling friction mu_r [1]

  /// Inside a section of the caller's.
  void declare(Parameters& parameters);
};

}  // namespace seedflow
