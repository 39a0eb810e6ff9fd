#include "wall_entries.h"

#include <cmath>

#include "seedflow/base/error.h"
#include "seedflow/base/parameters.h"

namespace seedflow {

std::vector<std::string> shape_names() {
  return {"plane", "rectangle", "box", "cylinder", "plate", "mesh"};
}
std::vector<std::string> outline_names() {
  return {"rectangle", "disc"};
}
std::vector<std::string> hole_pattern_names() {
  return {"none", "rectangular", "staggered", "ring", "list"};
}
std::vector<std::string> law_names() {
  return {"rest", "constant", "ramp", "sinusoid", "expression"};
}

void ShapeEntries::declare(Parameters& p, const std::string& shape) {
  const auto place = [&](const std::string& name, const std::string& doc) {
    p.vector(name, point, "m", Range::any(), doc);
  };
  if (shape == "plane") {
    place("Point", "Any point of the plane.");
    p.vector("Normal", normal, "1", Range::any(), "Into the room of the seeds.");
  } else if (shape == "rectangle") {
    place("Centre", "Of the rectangle.");
    p.vector("Normal", normal, "1", Range::any(), "Across the rectangle.");
    p.vector("Along", along, "1", Range::any(), "Direction of the length.");
    p.number("Length", length, "m", Range::non_negative(), "Extent along.");
    p.number("Width", width, "m", Range::non_negative(), "Extent across.");
  } else if (shape == "box") {
    p.vector("Low corner", low, "m", Range::any(), "Of the room of the seeds.");
    p.vector("High corner", high, "m", Range::any(), "Of the room of the seeds.");
  } else if (shape == "cylinder") {
    place("Base", "Centre of one end.");
    p.vector("Direction", normal, "1", Range::any(), "From the base to the other end.");
    p.number("Radius", radius, "m", Range::non_negative(), "Of the cylinder.");
    p.number("Length", length, "m", Range::non_negative(), "Of the cylinder.");
    side = "inside";
    p.choice("Side", side, {"inside", "outside", "both"},
             "Where seeds are; both: a thin tube that pushes to the side a seed's centre is on.");
    p.flag("Base cap", base_cap, "Closes the end at the base.");
    p.flag("End cap", end_cap, "Closes the other end.");
  } else if (shape == "plate") {
    declare_plate(p);
  } else if (shape == "mesh") {
    p.file("File", file, "STL file, ASCII or binary.");
    p.number("File unit", file_unit, "m", Range::positive(), "What 1 means in the file.");
    place("Shift", "Added to the coordinates.");
    side = "both";
    p.choice("Side", side, {"both", "outside", "inside"},
             "Where seeds are; outside and inside need a closed surface, both pushes to the side a seed's "
             "centre is on.");
  }
}

void ShapeEntries::declare_plate(Parameters& p) {
  p.vector("Centre", point, "m", Range::any(), "Of the middle plane.");
  p.vector("Normal", normal, "1", Range::any(), "Across the plate, towards its front.");
  p.vector("Along", along, "1", Range::any(), "First direction in the plate.");
  p.number("Thickness", thickness, "m", Range::non_negative(), "Of the plate.");
  p.choice("Outline", outline, outline_names(), "Of the plate.");
  if (outline == "disc") {
    p.number("Radius", radius, "m", Range::non_negative(), "Of the disc.");
  } else {
    p.number("Length", length, "m", Range::non_negative(), "Extent in the first direction.");
    p.number("Width", width, "m", Range::non_negative(), "Extent in the second direction.");
  }
  p.choice("Holes", holes, hole_pattern_names(), "Pattern of the circular holes.");
  if (holes == "none") return;
  p.number("Hole diameter", hole_diameter, "m", Range::non_negative(), "Of all holes.");
  p.number("Chamfer width", chamfer_width, "m", Range::non_negative(),
           "By how much the radius of a hole grows towards the front; 0: sharp edge.");
  p.number("Chamfer depth", chamfer_depth, "m", Range::non_negative(), "Over which depth it grows.");
  if (holes == "ring") {
    p.integer("Number of holes", n_ring, Range::non_negative(), "On the pitch circle.");
    p.number("Pitch radius", pitch_radius, "m", Range::non_negative(), "Of the circle through the centres.");
    p.number("First angle", first_angle, "rad", Range::any(), "Of hole 0, from the first direction.");
  } else if (holes == "list") {
    p.numbers(
        "Hole positions", positions, "m", Range::any(),
        "Two coordinates for each hole in the plate's directions, from its centre: x0, y0, x1, y1, ...");
  } else {
    p.number("Pitch along", pitch_along, "m", Range::non_negative(), "Between the holes of a row.");
    p.number("Pitch across", pitch_across, "m", Range::non_negative(), "Between rows.");
    p.integer("Holes along", n_along, Range::non_negative(), "In a row; 0: as many as fit.");
    p.integer("Holes across", n_across, Range::non_negative(), "Rows; 0: as many as fit.");
  }
}

namespace {

// The largest number of pitches that leaves every mouth inside.
int fitting(double room, double mouth, double pitch) {
  return pitch > 0 && room > 2 * mouth ? static_cast<int>((room - 2 * mouth) / pitch * (1 - 1e-12)) + 1 : 0;
}

// A lattice over a whole disc, less the holes that would cross its rim.
HoleList inside_disc(const HoleLattice& l, double radius, double mouth) {
  HoleList list;
  const HolePattern all = l;
  for (int h = 0; h < n_holes(all); ++h) {
    const PlatePoint x = hole_centre(all, h);
    if (std::hypot(x[0], x[1]) + mouth < radius) list.centre.push_back(x);
  }
  return list;
}

}  // namespace

Plate ShapeEntries::plate() const {
  Plate s;
  s.centre = point, s.normal = normal, s.along = along;
  s.thickness = thickness;
  if (outline == "disc")
    s.outline = DiscOutline{radius};
  else
    s.outline = RectangleOutline{length, width};
  if (holes == "none") return s;
  s.hole_radius = 0.5 * hole_diameter;
  s.chamfer_width = chamfer_width, s.chamfer_depth = chamfer_depth;
  const double mouth = s.hole_radius + chamfer_width;
  if (holes == "ring") {
    s.holes = HoleRing{n_ring, pitch_radius, first_angle};
  } else if (holes == "list") {
    if (positions.empty() || positions.size() % 2)
      throw InputError("Hole positions are " + std::to_string(positions.size()) +
                       " numbers; two for each hole are needed.");
    HoleList list;
    for (std::size_t i = 0; i < positions.size(); i += 2)
      list.centre.push_back({positions[i], positions[i + 1]});
    s.holes = list;
  } else {
    HoleLattice l;
    l.pitch_along = pitch_along, l.pitch_across = pitch_across;
    l.staggered = holes == "staggered";
    const bool disc = outline == "disc";
    const double shift = l.staggered ? 0.5 * pitch_along : 0;
    l.n_along = n_along > 0 ? n_along : fitting((disc ? 2 * radius : length) - shift, mouth, pitch_along);
    l.n_across = n_across > 0 ? n_across : fitting(disc ? 2 * radius : width, mouth, pitch_across);
    if (pitch_along > 0 && pitch_across > 0 && (l.n_along < 1 || l.n_across < 1))
      throw InputError("No hole of this diameter fits: the hole is larger than the plate.");
    if (disc && (n_along == 0 || n_across == 0))
      s.holes = inside_disc(l, radius, mouth);
    else
      s.holes = l;
  }
  return s;
}

Surface ShapeEntries::surface(const std::string& shape, const std::string& name) const {
  if (shape == "plane") return Plane{point, normal};
  if (shape == "rectangle") return Rectangle{point, normal, along, length, width};
  if (shape == "box") return Box{low, high};
  if (shape == "plate") return plate();
  if (shape == "cylinder") {
    const auto where = side == "inside"    ? Cylinder::Side::inside
                       : side == "outside" ? Cylinder::Side::outside
                                           : Cylinder::Side::both;
    return Cylinder{point, normal, radius, length, where, base_cap, end_cap};
  }
  if (file.empty()) throw InputError("No STL file is given. Set \"File\".");
  const auto where = side == "inside"    ? Mesh::Side::inside
                     : side == "outside" ? Mesh::Side::outside
                                         : Mesh::Side::both;
  return Mesh(read_wall_triangles(file, file_unit, point), where, name);
}

void LawEntries::declare(Parameters& p, const std::string& name, const std::string& speed_name,
                         const std::string& amplitude_name, const std::string& unit,
                         const std::string& speed_unit, const std::string& prefix) {
  p.choice(name, kind, law_names(), "How it goes in time; the entries below depend on it.");
  if (kind == "rest") return;
  if (kind == "constant" || kind == "ramp")
    p.number(speed_name, speed, speed_unit, Range::any(),
             kind == "ramp" ? "Reached at the end of the ramp." : "");
  if (kind == "ramp")
    p.number(prefix + " ramp", duration, "s", Range::non_negative(), "Duration of the acceleration.");
  if (kind == "sinusoid") {
    p.number(amplitude_name, amplitude, unit, Range::any(), "Of the vibration.");
    p.number(prefix + " frequency", frequency, "1/s", Range::positive(), "Of the vibration.");
    p.number(prefix + " phase", phase, "rad", Range::any(), "Of the vibration at the start.");
  }
  if (kind == "expression")
    p.text(prefix, expression,
           "In " + unit + " as a function of t, the time in s since the start, 0 at t = 0: for example " +
               (unit == "m" ? "0.001 * sin(2*pi*50*t)." : "2*pi*t + 0.1 * sin(40*t)."));
  p.number(prefix + " start", start, "s", Range::any(), "Until then the wall rests.");
  p.number(prefix + " stop", stop, "s", Range::any(), "From then on the wall stays where it is.");
}

TimeLaw LawEntries::law() const {
  TimeLaw l;
  if (kind == "constant") l.kind = TimeLaw::Kind::constant;
  if (kind == "ramp") l.kind = TimeLaw::Kind::ramp;
  if (kind == "sinusoid") l.kind = TimeLaw::Kind::sinusoid;
  if (kind == "expression") {
    l.kind = TimeLaw::Kind::expression;
    l.expression = std::make_shared<const TimeExpression>(expression);
  }
  l.speed = speed, l.duration = duration;
  l.amplitude = amplitude, l.frequency = frequency, l.phase = phase;
  l.start = start, l.stop = stop;
  return l;
}

}  // namespace seedflow
