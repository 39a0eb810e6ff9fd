#pragma once

#include <vector>

namespace seedflow {

/// All touching pairs with what they remember, by sub-sphere numbers (see Numbering), each pair once.
struct ContactHistory {
  struct Pair {
    int first, second;  ///< first < second
    double memory[8];   ///< see ContactMemoryPool
  };
  struct OnWall {
    int sphere, wall, feature;
    double memory[8];
    double normal[3];  ///< at the last substep
  };
  std::vector<Pair> pairs;      ///< sorted by first, second
  std::vector<OnWall> on_wall;  ///< sorted by sphere, wall, feature

  void sort();
  /// Sub-sphere i is called new_number[i] from now on; contacts of those with -1 are dropped. Where the order
  /// of two changes, springs change their sign, because they belong to the motion of the first.
  void renumber(const std::vector<int>& new_number);
};

}  // namespace seedflow
