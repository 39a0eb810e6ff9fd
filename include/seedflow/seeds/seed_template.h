#pragma once

#include <string>
#include <vector>

#include "seedflow/base/quaternion.h"
#include "seedflow/base/vector.h"

namespace seedflow {

/// A parallel bond between two sub-spheres of one seed (indices into SeedTemplate::position, first < second).
struct Bond {
  int first = 0, second = 0;
  double radius = 0;  ///< bond radius R_b [m]; area A = pi R_b^2
};

/// One seed model: sub-spheres packed into the shape of a seed and the bonds between them.
/// All seeds of one template share this reference; a plain sphere is a template with one sub-sphere.
///
/// Positions are relative to the centre of mass, in the frame of the principal axes of inertia, in m.
/// The sub-spheres' density is corrected (paper Eq. 9, rho_a = rho V / (N V_F)) so that the mass is exactly
/// that of the real seed: every sub-sphere carries mass * r_i^3 / sum r^3.
struct SeedTemplate {
  std::string name;
  std::vector<Vec3> position;  ///< sub-sphere centres [m]
  std::vector<double> radius;  ///< sub-sphere radii [m]
  std::vector<Bond> bond;

  double seed_volume = 0;   ///< volume of the real seed [m3], the buoyant volume
  double seed_density = 0;  ///< density of the real seed [kg/m3]
  Vec3 seed_semi_axes;      ///< of the shape the seed was packed into [m] (sphere: D/2 three times)

  /// The packed shape seen from the template: its centre [m] and the rotation from the shape's own axes
  /// (along which seed_semi_axes are given) into the template's. finish() moves both along with the
  /// sub-spheres.
  Vec3 seed_centre;
  Quaternion seed_frame;

  /// Density of each sub-sphere relative to the others; empty = all alike (paper Eq. 9). See
  /// match_real_inertia().
  std::vector<double> relative_density;

  // Derived by finish():
  double mass = 0;                     ///< of the seed [kg] = seed_density * seed_volume
  std::vector<double> sphere_mass;     ///< of each sub-sphere [kg], adds up to mass
  std::vector<double> sphere_inertia;  ///< 2/5 m r^2 of each sub-sphere [kg m2]
  Vec3 inertia;                        ///< principal moments of the rigid clump [kg m2]
  double bounding_radius = 0;          ///< max |position| + radius [m]
  double equivalent_diameter = 0;      ///< of the sphere with seed_volume [m]

  int n_spheres() const { return static_cast<int>(position.size()); }

  /// Moves the origin to the centre of mass, turns into the principal axes (moments in ascending order) and
  /// computes all derived members. A template that already is there to 1e-12 of its size is not moved, so
  /// that finish() is idempotent bit by bit. Errors: InputError on no sub-spheres, lists of unequal length,
  /// numbers that are not finite, radii, volume or density that are not positive, bonds between sub-spheres
  /// that do not exist.
  void finish();
};

}  // namespace seedflow
