#pragma once

#include <string>
#include <vector>

#include "seedflow/seeds/surface.h"
#include "seedflow/seeds/wall_motion.h"

namespace seedflow {

/// A wall: a surface that moves by a law in time and is made of a material. An inactive wall is not there.
struct Wall {
  std::string name;
  Surface surface;
  WallMotion motion;
  int material = 0;
  bool active = true;

  Wall() = default;
  Wall(std::string name, Surface surface, int material, WallMotion motion = {});
  /// An infinite plane that moves with a constant velocity [m/s].
  Wall(std::string name, const Vec3& point, const Vec3& normal, const Vec3& velocity, int material);

  /// Makes directions unit vectors; InputError naming the wall if shape or motion are impossible.
  void check();
};

/// All places of the wall within `reach` [m] of x at this time, in the lab frame, added to `out`. With a
/// placement made once per step it costs no evaluation of the motion.
void contacts_near(const Wall& wall, const Placement& place, const Vec3& x, double reach,
                   std::vector<WallPoint>& out);
void contacts_near(const Wall& wall, const Vec3& x, double reach, double time, std::vector<WallPoint>& out);

/// Whether a ball of this radius may touch the wall: false only if it surely does not.
bool may_touch(const Wall& wall, const Placement& place, const Vec3& centre, double radius);
bool may_touch(const Wall& wall, const Vec3& centre, double radius, double time);

Placement placement(const Wall& wall, double time);

/// A bound of the speed at which any part of the wall's surface inside the box from `low` to `high` may come
/// towards a point at rest [m/s]; a body of revolution that turns about its own axis does not come closer.
double largest_speed(const Wall& wall, double time, const Vec3& low, const Vec3& high);

}  // namespace seedflow
