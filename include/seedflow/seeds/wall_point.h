#pragma once

#include "seedflow/base/vector.h"

namespace seedflow {

/// A place where a sphere may touch a wall.
struct WallPoint {
  Vec3 normal;          ///< unit vector from the wall to the sphere's centre
  double distance = 0;  ///< from the surface to the centre [m]; negative when the centre is inside the wall
  int feature = 0;      ///< which part of the surface: the same number as long as a contact slides on it
  Vec3 velocity;        ///< of the wall's material at the surface point [m/s]
};

}  // namespace seedflow
