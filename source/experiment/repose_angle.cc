#include "seedflow/experiment/repose_angle.h"

#include <cmath>

#include "seedflow/base/error.h"

namespace seedflow {

namespace {

constexpr double degree = M_PI / 180;
const View front;  // x to the right, z up, seen against y

}  // namespace

void ReposeAngle::declare(Parameters& p) {
  granular.declare(p);
  granular.declare_air_drag(p);
  {
    const auto section =
        p.section("Tester", "The angle of repose tester. The paper prints no sizes; these are chosen.");
    p.number("Box width", box_width, "m", Range::positive(), "Inner width of the upper box.");
    p.number("Box height", box_height, "m", Range::positive(), "Of the upper box.");
    p.number("Depth", depth, "m", Range::positive(),
             "Between the front and back plates (plexiglass), of the whole tester.");
    p.number("Outlet", outlet, "m", Range::positive(),
             "Width of the opening in the middle of the box's floor; the box's width opens all of it.");
    p.number("Drop", drop, "m", Range::positive(), "From the floor of the box to the floor of the tester.");
    p.number("Floor width", floor_width, "m", Range::positive(), "Between the end walls of the tester.");
    p.text("Material", material, "Of the tester, one of Materials/Names.");
    p.text("Plate material", plate_material, "Of the front and back plates.");
    p.number("Board speed", board_speed, "m/s", Range::positive(),
             "At which the board below the outlet is pulled away, along x.");
  }
  const auto section = p.section("Angle", "How the angle is read off the picture of the heap.");
  p.number("Pixel", measuring.pixel, "m", Range{1e-6, 1e-3}, "Edge of a pixel.");
  p.number(
      "Lowest part", measuring.lowest_part, "1", Range::between(0, 0.5),
      "The flanks are fitted from this part of the heap's height, but not within the layer one seed high "
      "at its foot, ...");
  p.number("Highest part", measuring.highest_part, "1", Range::between(0.5, 1), "... up to this one.");
}

void ReposeAngle::check(const Parameters& p) {
  granular.check(p, {"Tester/Material", "Tester/Plate material"});
  measuring.smoothing = granular.model.diameter;
  measuring.layer = 1.05 * granular.model.diameter;
  if (outlet > box_width)
    p.reject("Tester/Outlet", "it is wider than the box", "use at most Tester/Box width");
  if (floor_width < box_width)
    p.reject("Tester/Floor width", "it is narrower than the box", "use at least Tester/Box width");
  if (outlet < 2 * granular.model.diameter)
    p.reject("Tester/Outlet", "seeds of this diameter would jam in it", "use several diameters");
  if (measuring.highest_part - measuring.lowest_part < 0.2)
    p.reject("Angle/Highest part", "less than a fifth of the height would be left to fit",
             "leave more between Lowest part and Highest part");
}

GranularScene ReposeAngle::scene() const {
  GranularScene s;
  const double margin = 2 * granular.model.diameter, x = 0.5 * floor_width, top = drop + box_height;
  s.low = {-x - margin, -margin, -margin};
  s.high = {x + margin, depth + margin, top + margin};
  const int resin = granular.materials.number(material),
            plexiglass = granular.materials.number(plate_material);
  const auto upright = [&](double at, double from, double to, const std::string& name) {
    return Wall(name, Rectangle{{at, 0.5 * depth, 0.5 * (from + to)}, {1, 0, 0}, {0, 1, 0}, depth, to - from},
                resin);
  };
  const auto flat = [&](double from, double to, double at, const std::string& name) {
    return Wall(name, Rectangle{{0.5 * (from + to), 0.5 * depth, at}, {0, 0, 1}, {1, 0, 0}, to - from, depth},
                resin);
  };
  s.walls = {Wall("floor", Plane{{0, 0, 0}, {0, 0, 1}}, resin),
             Wall("left end", Plane{{-x, 0, 0}, {1, 0, 0}}, resin),
             Wall("right end", Plane{{x, 0, 0}, {-1, 0, 0}}, resin),
             Wall("front plate", Plane{{0, 0, 0}, {0, 1, 0}}, plexiglass),
             Wall("back plate", Plane{{0, depth, 0}, {0, -1, 0}}, plexiglass),
             upright(-0.5 * box_width, drop, top, "left side of the box"),
             upright(0.5 * box_width, drop, top, "right side of the box")};
  if (outlet < box_width) {
    s.walls.push_back(flat(-0.5 * box_width, -0.5 * outlet, drop, "left ledge"));
    s.walls.push_back(flat(0.5 * outlet, 0.5 * box_width, drop, "right ledge"));
  }
  // The board lies a little below the ledges, so that it can be pulled away under them.
  const int board = static_cast<int>(s.walls.size());
  const double half = 0.5 * outlet + 0.25 * granular.model.diameter;
  s.walls.push_back(flat(-half, half, drop - 0.05 * granular.model.diameter, "board"));
  s.rooms = {{"upper box", {-0.5 * box_width, 0, drop}, {0.5 * box_width, depth, top}}};

  const double speed = board_speed, gone = (floor_width + outlet) / speed;
  s.begin = [board, speed, gone](Dem& dem, double start) {
    Wall& wall = dem.wall(board);
    wall.motion = WallMotion::constant({speed, 0, 0});
    wall.motion.displacement.start = start;
    wall.motion.displacement.stop = start + gone;
  };
  s.after_interval = [board, gone](Dem& dem, double time) {
    if (time >= gone) dem.set_wall_active(board, false);
  };
  const double rest = granular.rest_energy;
  s.finished = [rest](const Dem& dem, double time) {
    return time > 0.5 && kinetic_energy_per_seed(dem) < 1e-2 * rest;
  };
  s.columns = {{"seeds below", "1"}, {"angle left", "deg"}, {"angle right", "deg"}};
  s.observe = [this](const Dem& dem, double) -> std::vector<double> {
    double below = 0;
    for (int i = 0; i < dem.n_seeds(); ++i) below += dem.seed_state(i).centre.z < drop;
    try {
      const HeapAngle heap = measure(dem);
      return {below, heap.left.angle / degree, heap.right.angle / degree};
    } catch (const RunError&) {  // no heap yet
      return {below, 0, 0};
    }
  };
  s.not_of_filling = {"Angle/", "Tester/Board speed"};
  s.only_measuring = {"Angle/"};
  return s;
}

HeapAngle ReposeAngle::measure(const Dem& dem) const {
  std::vector<Disc> heap;
  for (const Disc& disc : spheres_from(front, dem))
    if (disc.y + disc.radius < drop - 0.1 * granular.model.diameter) heap.push_back(disc);
  return heap_angle(heap, 0, measuring);
}

}  // namespace seedflow
