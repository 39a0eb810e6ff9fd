#pragma once

#include <cmath>

#include "seedflow/seeds/seed_template.h"

namespace seedflow::test {

/// A simple cubic lattice of touching sub-spheres cut to a ball of diameter D, neighbours and face diagonals
/// bonded: a seed template that does not need the packing generator.
inline SeedTemplate lattice_seed(double diameter = 4e-3, double spacing = 0.8e-3, double density = 1340) {
  SeedTemplate t;
  t.name = "lattice";
  const double r = spacing / 2, reach = diameter / 2 - 0.9 * r;
  for (int i = -5; i <= 5; ++i)
    for (int j = -5; j <= 5; ++j)
      for (int k = -5; k <= 5; ++k) {
        const Vec3 x{(i + 0.5) * spacing, (j + 0.5) * spacing, (k + 0.5) * spacing};
        if (norm(x) <= reach) t.position.push_back(x), t.radius.push_back(r);
      }
  for (int a = 0; a < t.n_spheres(); ++a)
    for (int b = a + 1; b < t.n_spheres(); ++b)
      if (norm(t.position[a] - t.position[b]) < 1.5 * spacing) t.bond.push_back({a, b, r});
  t.seed_volume = M_PI / 6 * diameter * diameter * diameter;
  t.seed_density = density;
  t.seed_semi_axes = Vec3{diameter / 2, diameter / 2, diameter / 2};
  t.finish();
  return t;
}

/// One sub-sphere.
inline SeedTemplate single_sphere(double diameter = 4e-3, double density = 1340) {
  SeedTemplate t;
  t.name = "sphere";
  t.position.push_back({});
  t.radius.push_back(diameter / 2);
  t.seed_volume = M_PI / 6 * diameter * diameter * diameter;
  t.seed_density = density;
  t.seed_semi_axes = Vec3{diameter / 2, diameter / 2, diameter / 2};
  t.finish();
  return t;
}

/// A straight chain of n touching sub-spheres along x, neighbours bonded.
inline SeedTemplate chain(int n, double radius = 0.5e-3, double density = 1340) {
  SeedTemplate t;
  t.name = "chain";
  for (int i = 0; i < n; ++i) t.position.push_back({2 * radius * i, 0, 0}), t.radius.push_back(radius);
  for (int i = 0; i + 1 < n; ++i) t.bond.push_back({i, i + 1, radius});
  t.seed_volume = n * 4.0 / 3 * M_PI * radius * radius * radius;
  t.seed_density = density;
  t.seed_semi_axes = Vec3{n * radius, radius, radius};
  t.finish();
  return t;
}

}  // namespace seedflow::test
