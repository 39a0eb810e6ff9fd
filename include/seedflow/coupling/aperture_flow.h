#pragma once

#include "seedflow/base/vector.h"

namespace seedflow {

/// Potential flow through a circular opening of radius a in a plane wall: velocity of the air at a point on
/// the side it comes from. With oblate spheroidal coordinates (distance from the axis
/// a sqrt(1 + zeta^2) sqrt(1 - xi^2), height above the wall a zeta xi)
///   |u| = Q / (2 pi a^2 sqrt(1 + zeta^2) sqrt(zeta^2 + xi^2)),
/// along the hyperbolas xi = const towards the opening; far away the sink Q / (2 pi r^2). Exact for an ideal
/// fluid and any wall without thickness (Lamb, Hydrodynamics, 6th ed. 1932, section 108); at the rim |u| has
/// no bound, so it is cut at `limit`, the speed that the pressure difference can give (Bernoulli).
///
/// \param x from the centre of the opening [m]; x.z is the height above the wall, points below it are taken
/// to lie on it
/// \param flow Q, through the opening [m3/s]
/// \param limit largest speed [m/s]
Vec3 aperture_velocity(const Vec3& x, double radius, double flow, double limit);

}  // namespace seedflow
