#pragma once

#include <variant>

#include "seedflow/seeds/surface_box.h"
#include "seedflow/seeds/surface_cylinder.h"
#include "seedflow/seeds/surface_mesh.h"
#include "seedflow/seeds/surface_plane.h"
#include "seedflow/seeds/surface_plate.h"

namespace seedflow {

/// The shapes a wall can have. Each offers check(name), points_near(x, reach, out) and clearance(x) in the
/// wall's own frame, which is the lab frame as long as the wall has not moved.
using Surface = std::variant<Plane, Rectangle, Box, Cylinder, Plate, Mesh>;

}  // namespace seedflow
