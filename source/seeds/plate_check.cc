// What a plate with holes must fulfil.

#include <algorithm>
#include <cmath>
#include <sstream>

#include "seedflow/base/error.h"
#include "seedflow/seeds/frame.h"
#include "seedflow/seeds/surface_plate.h"

namespace seedflow {
namespace {

std::string mm(double a) {
  std::ostringstream text;
  text << 1e3 * a << " mm";
  return text.str();
}

void check_outline(const RectangleOutline& o, const std::string& wall) {
  if (!(o.length > 0 && o.width > 0))
    throw InputError(wall + ": a plate needs a length and a width above 0 m; they are " + mm(o.length) +
                     " and " + mm(o.width) + ".");
}
void check_outline(const DiscOutline& o, const std::string& wall) {
  if (!(o.radius > 0))
    throw InputError(wall + ": a disc needs a radius above 0 m; it is " + mm(o.radius) + ".");
}
double inscribed_radius(const RectangleOutline& o) {
  return 0.5 * std::min(o.length, o.width);
}
double inscribed_radius(const DiscOutline& o) {
  return o.radius;
}

struct CheckPattern {
  const std::string& wall;
  void operator()(std::monostate) const {}
  void operator()(const HoleList&) const {}
  void operator()(const HoleRing& r) const {
    if (r.n < 1 || !(r.pitch_radius > 0))
      throw InputError(wall +
                       ": a ring of holes needs at least 1 hole and a pitch radius above 0 m; it has " +
                       std::to_string(r.n) + " holes at " + mm(r.pitch_radius) + ".");
  }
  void operator()(const HoleLattice& l) const {
    if (l.n_along < 1 || l.n_across < 1 || !(l.pitch_along > 0 && l.pitch_across > 0))
      throw InputError(wall +
                       ": a lattice of holes needs at least 1 x 1 holes and pitches above 0 m; it has " +
                       std::to_string(l.n_along) + " x " + std::to_string(l.n_across) + " holes " +
                       mm(l.pitch_along) + " and " + mm(l.pitch_across) + " apart.");
  }
};

void check_holes(const Plate& p, const std::string& wall) {
  const double a = p.hole_radius, mouth = a + p.chamfer_width;
  if (!(a > 0)) throw InputError(wall + ": the holes have no diameter. Give one above 0 m, or no holes.");
  if (p.chamfer_width < 0 || p.chamfer_depth < 0 || (p.chamfer_width > 0) != (p.chamfer_depth > 0))
    throw InputError(wall + ": a chamfer needs a width and a depth above 0 m; they are " +
                     mm(p.chamfer_width) + " and " + mm(p.chamfer_depth) + ".");
  if (p.chamfer_depth >= p.thickness)
    throw InputError(wall + ": the chamfer is " + mm(p.chamfer_depth) + " deep, the plate only " +
                     mm(p.thickness) + " thick. Make the chamfer shallower.");
  const double room = std::visit([](const auto& o) { return inscribed_radius(o); }, p.outline);
  if (mouth >= room)
    throw InputError(wall + ": the hole is larger than the plate: its diameter is " + mm(2 * mouth) +
                     " (with chamfer), the plate is " + mm(2 * room) +
                     " wide. Make the hole smaller or the plate larger.");
  for (int hole = 0; hole < n_holes(p.holes); ++hole) {
    const PlatePoint x = hole_centre(p.holes, hole);
    const double room_left = -p.outside(x);
    if (!(room_left > mouth))
      throw InputError(wall + ": hole " + std::to_string(hole) + " at (" + mm(x[0]) + ", " + mm(x[1]) +
                       ") from the centre does not lie inside the plate: its edge is " +
                       mm(mouth - room_left) + " beyond the rim" +
                       (std::holds_alternative<HoleRing>(p.holes)
                            ? ". Make the pitch radius smaller or the disc larger."
                            : ". Use fewer holes, smaller pitches, or a larger plate."));
  }
  const double distance = least_hole_distance(p.holes);
  if (!(distance > 2 * mouth))
    throw InputError(wall + ": holes overlap: two centres are " + mm(distance) + " apart, the holes are " +
                     mm(2 * mouth) + " wide (with chamfer). Use fewer or smaller holes or a larger pitch.");
}

}  // namespace

void Plate::check(const std::string& name) {
  const std::string wall = "Wall '" + name + "'";
  const double size = norm(normal);
  if (!(size > 0) || !std::isfinite(size))
    throw InputError(wall + ": the normal is zero. Give the direction across the plate.");
  normal /= size;
  along = across(normal, along).u;
  if (!(thickness > 0))
    throw InputError(wall + ": a plate needs a thickness above 0 m; it is " + mm(thickness) +
                     ". Take a rectangle for a plate without thickness.");
  std::visit([&](const auto& o) { check_outline(o, wall); }, outline);
  std::visit(CheckPattern{wall}, holes);
  if (n_holes(holes) == 0) {
    holes = std::monostate{};
    return;
  }
  check_holes(*this, wall);
  if (auto* list = std::get_if<HoleList>(&holes)) list->make_grid(hole_radius + chamfer_width + thickness);
}

}  // namespace seedflow
