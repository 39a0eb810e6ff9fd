#include "seedflow/base/device_geometry.h"

#include <algorithm>
#include <cmath>

#include "seedflow/base/parameters.h"

namespace seedflow {

namespace {

/// Part of a disc of radius 1 on the positive side of a line at distance d, positive inside: 0 at d = -1.
double part_beyond(double d) {
  if (d <= -1) return 0;
  if (d >= 1) return 1;
  return 0.5 + (std::asin(d) + d * std::sqrt(1 - d * d)) / M_PI;
}

}  // namespace

void DeviceGeometry::declare(Parameters& p) {
  const auto section = p.section(
      "Device",
      "Disc, holes and chambers. The disc's front face is z = 0, seeds are at z < 0, the vacuum is behind; "
      "angles count from +x in the sense of the rotation, -90 deg is the bottom.");
  p.number("Disc radius", disc_radius, "m", Range::positive(), "Of the turning disc.");
  p.number("Disc thickness", thickness, "m", Range::positive(), "Length of the holes.");
  p.integer("Holes", holes, Range::between(2, 1000), "Places of holes, evenly spaced on the pitch circle.");
  p.integer("Drilled", drilled, Range::between(0, 1000),
            "How many of the places have a hole, from the first one on; 0: all.");
  p.number("Pitch radius", pitch_radius, "m", Range::positive(), "Of the circle of the holes' centres.");
  p.number("Hole diameter", hole_diameter, "m", Range::positive(), "Of the straight part of a hole.");
  p.number("Chamfer", chamfer, "m", Range::non_negative(),
           "Of the holes on the seeds' side: width = depth. 0: sharp edge.");
  p.number("First angle", first_angle, "rad", Range::any(), "Of the first hole before the disc turns.");
  p.number("Chamber inner radius", chamber_inner_radius, "m", Range::non_negative(), "Of the seed chamber.");
  p.number("Chamber outer radius", chamber_outer_radius, "m", Range::positive(), "Of the seed chamber.");
  p.number("Chamber depth", chamber_depth, "m", Range::positive(), "Of the seed chamber along the axis.");
  p.number("Vacuum from", vacuum_from, "rad", Range::any(), "Angle at which the vacuum chamber begins.");
  p.number("Vacuum to", vacuum_to, "rad", Range::any(),
           "Angle at which it ends: there the holes let the seeds go.");
  p.number("Vacuum inner radius", vacuum_inner_radius, "m", Range::non_negative(), "Of the vacuum chamber.");
  p.number("Vacuum outer radius", vacuum_outer_radius, "m", Range::positive(), "Of the vacuum chamber.");
  p.number("Vacuum depth", vacuum_depth, "m", Range::positive(), "Of the vacuum chamber along the axis.");
}

void DeviceGeometry::check(const Parameters& p) const {
  const double mouth = hole_radius() + chamfer;
  if (drilled > holes)
    p.reject("Device/Drilled", "there are fewer places than holes", "use at most Device/Holes");
  if (pitch_radius + mouth >= disc_radius)
    p.reject("Device/Pitch radius", "the holes reach over the disc's rim",
             "use less than Device/Disc radius by more than a hole's radius and chamfer");
  if (2 * pitch_radius * std::sin(0.5 * pitch_angle()) <= 2 * mouth)
    p.reject("Device/Hole diameter", "neighbouring holes overlap, chamfers included",
             "use fewer or smaller holes, or a larger Device/Pitch radius");
  if (chamfer >= thickness)
    p.reject("Device/Chamfer", "it is as deep as the disc", "use less than Device/Disc thickness");
  if (chamber_inner_radius >= chamber_outer_radius)
    p.reject("Device/Chamber inner radius", "it is not inside the outer one",
             "use less than Device/Chamber outer radius");
  if (chamber_outer_radius > disc_radius)
    p.reject("Device/Chamber outer radius", "the chamber reaches beyond the disc that closes it",
             "use at most Device/Disc radius");
  if (pitch_radius - mouth <= chamber_inner_radius || pitch_radius + mouth >= chamber_outer_radius)
    p.reject("Device/Pitch radius", "the holes are not inside the seed chamber",
             "put it between the chamber's inner and outer radius");
  if (vacuum_inner_radius >= vacuum_outer_radius)
    p.reject("Device/Vacuum inner radius", "it is not inside the outer one",
             "use less than Device/Vacuum outer radius");
  if (pitch_radius - hole_radius() <= vacuum_inner_radius ||
      pitch_radius + hole_radius() >= vacuum_outer_radius)
    p.reject("Device/Pitch radius", "the holes do not open into the vacuum chamber",
             "put it between the vacuum chamber's inner and outer radius");
  if (!(vacuum_to > vacuum_from) || vacuum_to - vacuum_from >= 2 * M_PI)
    p.reject("Device/Vacuum to", "the arc must be longer than 0 and shorter than a whole turn",
             "let it end after Device/Vacuum from, in the sense of the rotation");
  if ((vacuum_to - vacuum_from) * pitch_radius <= hole_diameter)
    p.reject("Device/Vacuum to", "the arc is shorter than one hole", "use a longer arc");
}

double DeviceGeometry::pitch_angle() const {
  return 2 * M_PI / holes;
}

double DeviceGeometry::hole_angle(int k, double turned) const {
  return first_angle + k * pitch_angle() + turned;
}

Vec3 DeviceGeometry::hole_centre(int k, double turned) const {
  const double angle = hole_angle(k, turned);
  return {pitch_radius * std::cos(angle), pitch_radius * std::sin(angle), 0};
}

double DeviceGeometry::hole_area() const {
  return M_PI * hole_radius() * hole_radius();
}

double DeviceGeometry::exposure(double angle) const {
  // Nearest turn to the middle of the arc; the nearer of the two edges decides.
  const double middle = 0.5 * (vacuum_from + vacuum_to);
  const double off = std::remainder(angle - middle, 2 * M_PI);
  const double inside = 0.5 * (vacuum_to - vacuum_from) - std::abs(off);  // [rad] from the nearer edge
  const double distance =
      std::abs(inside) < 0.5 * M_PI ? pitch_radius * std::sin(inside) : std::copysign(pitch_radius, inside);
  return part_beyond(distance / hole_radius());
}

std::vector<Vec3> DeviceGeometry::sucking_holes(double turned) const {
  std::vector<Vec3> places;
  for (int k = 0; k < n_holes(); ++k) {
    if (exposure(hole_angle(k, turned)) <= 0) continue;
    const Vec3 mouth = hole_centre(k, turned);
    for (const double part : {0.0, 0.5, 1.0}) places.push_back(mouth + Vec3{0, 0, part * thickness});
  }
  return places;
}

}  // namespace seedflow
