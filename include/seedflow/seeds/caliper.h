#pragma once

#include <vector>

#include "seedflow/seeds/seed_template.h"
#include "seedflow/seeds/shape.h"

namespace seedflow {

/// Nearly even directions over the sphere (Fibonacci lattice), unit vectors.
std::vector<Vec3> even_directions(int n);

/// Widths between two parallel planes that touch the body, over all directions [m].
struct Caliper {
  double mean = 0, smallest = 0, largest = 0;
};
Caliper caliper(const SeedTemplate& seed, int n_directions = 2000);
Caliper caliper(const Shape& shape, int n_directions = 2000);

/// How rough the clump is compared with the real seed. Rays leave the seed's centre in all directions; where
/// one last leaves a sub-sphere, the depth below the real seed's surface is measured (on a sphere D/2 minus
/// the clump's radius in that direction). Directions in which the ray finds nothing, or only something deeper
/// than the largest sub-sphere's diameter (it looks through a gap into the inside), are not covered.
struct SurfaceRoughness {
  double bs = 0;          ///< the paper's surface roughness BS: sub-sphere diameter / seed diameter [1]
  double mean_depth = 0;  ///< over the covered directions [m]
  double rms = 0;         ///< of the depth about its mean, over the covered directions [m]
  double covered = 0;     ///< share of the directions [1]
};
SurfaceRoughness surface_roughness(const SeedTemplate& seed, const Shape& shape, int n_directions = 2000);
/// The same against the ellipsoid with seed.seed_semi_axes.
SurfaceRoughness surface_roughness(const SeedTemplate& seed, int n_directions = 2000);

}  // namespace seedflow
