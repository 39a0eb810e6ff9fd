#pragma once

#include <functional>
#include <random>
#include <string>
#include <vector>

#include "seedflow/base/quaternion.h"
#include "seedflow/base/vector.h"

namespace seedflow {

/// A room that is filled with seeds of one group before the experiment begins.
struct FillingRoom {
  std::string name;
  Vec3 low, high;                                                 ///< [m]
  std::function<bool(const Vec3&, double radius)> has = nullptr;  ///< whether a ball fits; none: always
  double share = 1;                                               ///< of all seeds
  int group = 0;                                                  ///< colour
};

/// Random numbers that are the same on every machine.
class RandomNumbers {
 public:
  explicit RandomNumbers(unsigned number) : engine(number) {}
  double uniform() { return static_cast<double>(engine() >> 11) * 0x1p-53; }  ///< in [0, 1)
  /// All orientations alike likely (Shoemake 1992).
  Quaternion orientation();

 private:
  std::mt19937_64 engine;
};

/// Places for n balls of the given radius in the room: a loose lattice from the bottom up, each place shaken
/// at random, so that no two balls touch. Errors: InputError if the room is full before.
std::vector<Vec3> lattice_places(const FillingRoom& room, int n, double radius, RandomNumbers& random);

}  // namespace seedflow
