#pragma once

#include <vector>

namespace seedflow {

/// One touching pair: sub-sphere `sphere_a` of seed `label_a` with sub-sphere `sphere_b` of seed `label_b`
/// or, if label_b is -1, with feature `feature` of wall `wall`. Labels are those of Dem::seed_label().
struct NetworkContact {
  long label_a = 0, label_b = -1;
  int sphere_a = 0, sphere_b = 0;
  int wall = -1, feature = 0;
  double normal_force = 0;  ///< positive: repulsion, at the last substep [N]
};

/// Sorted by (label_a, sphere_a, label_b, sphere_b, wall, feature); contacts between seeds have label_a <
/// label_b.
using ContactNetwork = std::vector<NetworkContact>;

}  // namespace seedflow
