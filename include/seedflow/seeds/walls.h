#pragma once

#include <string>

#include "seedflow/base/vector.h"

namespace seedflow {

/// A plane wall. Seeds stay on the side its normal points to.
struct Wall {
  std::string name;
  Vec3 point;     ///< a point of the plane [m]; moves with the velocity
  Vec3 normal;    ///< into the domain; made a unit vector by Dem::add_wall
  Vec3 velocity;  ///< [m/s], constant
  int material = 0;
};

}  // namespace seedflow
