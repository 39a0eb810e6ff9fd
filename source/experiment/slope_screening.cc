#include "seedflow/experiment/slope_screening.h"

#include <algorithm>
#include <cmath>

#include "seedflow/base/error.h"

namespace seedflow {

namespace {

/// Staggered rows along x; rows and columns keep a hole's radius and half a millimetre from the plate's edge.
HoleLattice holes_of(const SlopeScreening& e) {
  HoleLattice holes;
  holes.pitch_along = e.pitch;
  holes.pitch_across = e.pitch * std::sqrt(0.75);
  holes.staggered = true;
  const double rim = 0.5 * e.hole + 0.5e-3;
  // The shifted rows need half a pitch more room.
  holes.n_along = 1 + static_cast<int>((e.length - 2 * rim - 0.5 * e.pitch) / holes.pitch_along);
  holes.n_across = 1 + static_cast<int>((e.width - 2 * rim) / holes.pitch_across);
  return holes;
}

}  // namespace

double percentage(const RegionCensus& census, int region) {
  return census.mass_in() > 0 ? 100 * census.mass_counted(region) / census.mass_in() : 0;
}

RegionCensus SlopeScreening::bins() const {
  // A seed is in a bin when it has left the hole with all of its diameter. The bins stand below fifths of the
  // plate; their edges are far lower than a seed falls in a series interval.
  const double d = granular.model.diameter, far = 1;
  std::vector<Region> regions;
  for (int area = 0; area < n_areas; ++area) {
    const double from = area == 0 ? -far : length * area / n_areas;
    const double to = area == n_areas - 1 ? length + d : length * (area + 1) / n_areas;
    regions.push_back({"area " + std::to_string(area + 1),
                       BoxRegion{{from, -far, -far}, {to, far, -thickness - d}}, Region::Action::remove});
  }
  regions.push_back({"over the end", HalfSpaceRegion{{length + d, 0, 0}, {1, 0, 0}}, Region::Action::remove});
  return RegionCensus(regions);
}

int SlopeScreening::n_holes() const {
  return seedflow::n_holes(holes_of(*this));
}

Vec3 SlopeScreening::gravity() const {
  const double g = norm(granular.dem.gravity);
  return {g * std::sin(inclination), 0, -g * std::cos(inclination)};
}

Vec3 SlopeScreening::loading_top() const {
  return {-loading_length * std::cos(loading_steepness), 0, loading_length * std::sin(loading_steepness)};
}

void SlopeScreening::declare(Parameters& p) {
  granular.declare(p);
  granular.declare_air_drag(p);
  const auto section =
      p.section("Screen", "The inclined sieve plate, its loading area and its insert plate.");
  p.number("Inclination", inclination, "rad", Range::between(0, 1.2), "Of the plate against the horizontal.");
  p.number("Length", length, "m", Range::positive(), "Of the plate along the slope.");
  p.number("Width", width, "m", Range::positive(), "Of the plate and the loading area.");
  p.number("Thickness", thickness, "m", Range::positive(), "Of the plate.");
  p.number("Hole diameter", hole, "m", Range::positive(), "Of the round holes.");
  p.number("Hole pitch", pitch, "m", Range::positive(),
           "Distance of neighbouring holes in staggered rows. The paper prints none; chosen.");
  p.number("Loading length", loading_length, "m", Range::positive(),
           "Of the loading area along the slope. The paper prints none; chosen.");
  p.number("Loading steepness", loading_steepness, "rad", Range::between(0, 1.2),
           "By which the loading area's floor is steeper than the plate. The paper prints none; chosen.");
  p.number("Insert speed", insert_speed, "m/s", Range::positive(),
           "At which the insert plate in front of the seeds is pulled away, along the plate's normal.");
  p.text("Material", material, "Of plate and walls, one of Materials/Names.");
}

void SlopeScreening::check(const Parameters& p) {
  granular.check(p, {"Screen/Material"});
  if (pitch <= hole) p.reject("Screen/Hole pitch", "the holes overlap", "use more than Screen/Hole diameter");
  if (hole + 1e-3 > std::min(length, width) / 2)
    p.reject("Screen/Hole diameter", "the plate has no room for such holes", "use a larger plate");
  const Vec3 g = granular.dem.gravity;
  if (g.x != 0 || g.y != 0 || !(g.z < 0))
    p.reject("Seeds motion/Gravity", "the plate is inclined by Screen/Inclination; gravity must point down",
             "write it as 0, 0, -9.81");
  granular.dem.gravity = gravity();
}

GranularScene SlopeScreening::scene(RegionCensus& census) const {
  GranularScene s;
  const int resin = granular.materials.number(material);
  const double d = granular.model.diameter, height = 150e-3, below = thickness + 12 * d;
  const Vec3 top = loading_top();
  s.low = {top.x - d, -d, -below};
  s.high = {length + 40 * d, width + d, height};

  Plate plate;
  plate.centre = {0.5 * length, 0.5 * width, -0.5 * thickness};
  plate.thickness = thickness;
  plate.outline = RectangleOutline{length, width};
  plate.holes = holes_of(*this);
  plate.hole_radius = 0.5 * hole;
  s.walls = {Wall("sieve plate", plate, resin),
             Wall("floor of the loading area",
                  Rectangle{{0.5 * top.x, 0.5 * width, 0.5 * top.z},
                            {std::sin(loading_steepness), 0, std::cos(loading_steepness)},
                            {std::cos(loading_steepness), 0, -std::sin(loading_steepness)},
                            loading_length,
                            width},
                  resin),
             Wall("back of the loading area", Plane{top, {1, 0, 0}}, resin),
             Wall("left side", Plane{{0, 0, 0}, {0, 1, 0}}, resin),
             Wall("right side", Plane{{0, width, 0}, {0, -1, 0}}, resin)};
  const int insert = static_cast<int>(s.walls.size());
  // The insert stands 0.1 d in front of the first holes' plate edge, on the loading area's floor.
  s.walls.emplace_back("insert plate",
                       Rectangle{{0, 0.5 * width, 0.5 * height}, {1, 0, 0}, {0, 1, 0}, width, height}, resin);
  s.rooms = {{"loading area", top, {0, width, height}}};

  const double speed = insert_speed, gone = height / speed;
  s.begin = [insert, speed, gone](Dem& dem, double start) {
    Wall& wall = dem.wall(insert);
    wall.motion = WallMotion::constant({0, 0, speed});
    wall.motion.displacement.start = start;
    wall.motion.displacement.stop = start + gone;
  };
  s.after_interval = [insert, gone, &census](Dem& dem, double time) {
    if (time >= gone) dem.set_wall_active(insert, false);
    census.update(dem);
  };
  s.finished = [](const Dem& dem, double time) {
    return time > 0.5 && (dem.n_seeds() == 0 || kinetic_energy_per_seed(dem) < 1e-11);
  };
  for (int area = 0; area < n_areas; ++area) s.columns.push_back({"area " + std::to_string(area + 1), "%"});
  s.columns.push_back({"over the end", "%"});
  s.observe = [&census](const Dem&, double) {
    std::vector<double> row;
    for (int region = 0; region <= n_areas; ++region) row.push_back(percentage(census, region));
    return row;
  };
  s.save = [&census](std::ostream& out) { census.save(out); };
  s.load = [&census](std::istream& in) { census.load(in); };
  s.not_of_filling = {"Screen/Inclination", "Screen/Insert speed", "Screen/Hole diameter",
                      "Screen/Hole pitch"};
  return s;
}

}  // namespace seedflow
