#pragma once

#include <algorithm>
#include <vector>

#include "seedflow/seeds/seed_store.h"

namespace seedflow {

/// Numbers all seeds and sub-spheres through in the order of memory: stores one after the other, slots in
/// order, sub-spheres of a slot one after the other. Not the user's order: sorting changes it.
struct Numbering {
  std::vector<int> first_seed, first_sphere;  ///< [store], and the totals at the end

  Numbering() = default;
  explicit Numbering(const std::vector<SeedStore>& stores) : first_seed{0}, first_sphere{0} {
    for (const SeedStore& s : stores) {
      const int n = static_cast<int>(s.seed.size());
      first_seed.push_back(first_seed.back() + n);
      first_sphere.push_back(first_sphere.back() + n * s.n_spheres());
    }
  }

  int n_seeds() const { return first_seed.back(); }
  int n_spheres() const { return first_sphere.back(); }
  int store_of_seed(int seed) const { return last_not_above(first_seed, seed); }
  int store_of_sphere(int sphere) const { return last_not_above(first_sphere, sphere); }

 private:
  static int last_not_above(const std::vector<int>& first, int number) {
    return static_cast<int>(std::upper_bound(first.begin(), first.end(), number) - first.begin()) - 1;
  }
};

}  // namespace seedflow
