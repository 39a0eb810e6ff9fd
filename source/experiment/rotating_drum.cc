#include "seedflow/experiment/rotating_drum.h"

#include <algorithm>
#include <cmath>

#include "seedflow/base/binary.h"
#include "seedflow/base/error.h"
#include "seedflow/output/folder.h"
#include "seedflow/output/svg.h"

namespace seedflow {

namespace {

const View front;  // x to the right, z up, seen against y
constexpr double degree = M_PI / 180;
/// A seed counts as seen if this share of its disc is not hidden.
constexpr double seen_share = 0.3;

}  // namespace

void VelocityProfile::add(double y, double velocity) {
  const double at = (y - low) / bin;
  if (at < 0 || at >= static_cast<double>(sum.size())) return;
  sum[static_cast<std::size_t>(at)] += velocity;
  count[static_cast<std::size_t>(at)] += 1;
}

void VelocityProfile::mean(std::vector<double>& y, std::vector<double>& velocity, double least) const {
  for (std::size_t i = 0; i < sum.size(); ++i) {
    if (count[i] < least) continue;
    y.push_back(low + (static_cast<double>(i) + 0.5) * bin);
    velocity.push_back(sum[i] / count[i]);
  }
}

void RotatingDrum::declare(Parameters& p) {
  granular.declare(p);
  granular.declare_air_drag(p);
  const auto section = p.section("Drum", "The rotating container and what is measured in it.");
  p.number("Radius", radius, "m", Range::positive(), "Inside. The paper prints no size; chosen.");
  p.number("Length", length, "m", Range::positive(), "Inside. The paper prints no size; chosen.");
  p.number("Speed", speed, "rad/s", Range::positive(), "The paper's: 20, 40, 60 rpm.");
  p.number("Revolutions", revolutions, "1", Range::positive(), "Length of the run; sets its end time.");
  p.flag("Diaphragm", diaphragm,
         "true: half of the seeds in one colour on each side of a diaphragm, taken away at the start. false: "
         "one colour.");
  p.text("Barrel material", barrel_material, "One of Materials/Names.");
  p.text("End material", end_material, "Of the two end walls, which turn with the barrel.");
  p.numbers("Lacey cells", cells, "m", Range::positive(), "Edges of the sample cells. The paper's: 5 mm.");
  p.choice(
      "Lacey count", lacey_count, {"seeds", "sub-spheres"},
      "What is counted in the cells. seeds: by their centres; the view counts those seen through the "
      "front end. sub-spheres: all of them, the view in columns through the whole drum; a random mixture "
      "of seeds then stays below 100 %, because sub-spheres of one seed have one colour.");
  p.numbers("Pictures at", picture_at, "1", Range::non_negative(), "Revolutions.");
  p.number("Plateau from", plateau_from, "1", Range::non_negative(),
           "Revolutions from which on mixing index and dynamic angle are averaged.");
  p.number("Profile from", profile_from, "1", Range::non_negative(),
           "Revolutions from which on the velocity across the bed is averaged.");
  p.file("Measurements", measurements,
         "CSV with measured values of the quantity \"velocity\" (along the surface, downhill) over the "
         "coordinate (distance from the axis along the surface's normal), for the report; none if empty.");
}

void RotatingDrum::check(const Parameters& p) {
  granular.check(p, {"Drum/Barrel material", "Drum/End material"});
  if (p.is_set("Run/End time"))
    p.reject("Run/End time", "the drum's run ends after Drum/Revolutions", "set Drum/Revolutions instead");
  granular.end_time = revolutions * 2 * M_PI / speed;
  if (granular.series_interval > granular.end_time)
    p.reject("Run/Series interval", "it is longer than the run", "use a shorter one");
  if (plateau_from >= revolutions)
    p.reject("Drum/Plateau from", "the run ends before", "use less than Drum/Revolutions");
  if (radius < 3 * granular.model.diameter)
    p.reject("Drum/Radius", "it is less than three seeds", "use a larger drum or smaller seeds");
  if (length < 2 * granular.model.diameter)
    p.reject("Drum/Length", "it is less than two seeds", "use a longer drum or smaller seeds");
}

GranularScene RotatingDrum::scene(Gathered& gathered, const std::filesystem::path& folder) const {
  GranularScene s;
  const double d = granular.model.diameter, r = radius;
  s.low = {-r - d, -d, -r - d};
  s.high = {r + d, length + d, r + d};
  const int barrel = granular.materials.number(barrel_material),
            end = granular.materials.number(end_material);
  Cylinder inside;
  inside.base = {0, -d, 0};  // longer than the room, so that its rims are out of reach
  inside.axis = {0, 1, 0};
  inside.radius = r;
  inside.length = length + 2 * d;
  inside.base_cap = inside.end_cap = false;
  s.walls = {Wall("barrel", inside, barrel), Wall("front end", Plane{{0, 0, 0}, {0, 1, 0}}, end),
             Wall("back end", Plane{{0, length, 0}, {0, -1, 0}}, end)};
  const int n_turning = static_cast<int>(s.walls.size());
  if (diaphragm)
    s.walls.emplace_back(
        "diaphragm", Rectangle{{0, 0.5 * length, 0}, {1, 0, 0}, {0, 1, 0}, length + 2 * d, 2 * r + d}, end);

  if (diaphragm) {
    s.rooms = {{"left half of the drum", {-r, 0, -r}, {0, length, r}, 0.5, 0},
               {"right half of the drum", {0, 0, -r}, {r, length, r}, 0.5, 1}};
  } else {
    s.rooms = {{"drum", {-r, 0, -r}, {r, length, r}}};
  }

  s.begin = [this, n_turning](Dem& dem, double start) {
    for (int w = 0; w < n_turning; ++w) {
      dem.wall(w).motion = WallMotion::rotation({0, 0, 0}, {0, -speed, 0});
      dem.wall(w).motion.angle.start = start;
    }
    if (diaphragm) dem.set_wall_active(n_turning, false);
  };

  gathered.profile.low = -r;
  gathered.profile.bin = d / 2;
  const auto n_bins = static_cast<std::size_t>(std::ceil(2 * r / gathered.profile.bin));
  gathered.profile.sum.assign(n_bins, 0);
  gathered.profile.count.assign(n_bins, 0);
  s.after_interval = [this, &gathered, folder, d](Dem& dem, double time) {
    const double now = revolutions_at(time);
    for (const double at : picture_at)
      if (gathered.last_revolutions < at && at <= now + 1e-9 && !folder.empty())
        write_file_atomically(
            folder / ("drum_" + printed_number(at) + "_revolutions.svg"),
            picture(dem, printed_number(at) + (at == 1 ? " revolution" : " revolutions")).svg());
    gathered.last_revolutions = now + 1e-9;
    if (now < profile_from) return;
    const double angle = measure_contour(dem).angle;
    const Vec3 downhill{-std::cos(angle), 0, -std::sin(angle)}, normal{-std::sin(angle), 0, std::cos(angle)};
    for (int i = 0; i < dem.n_seeds(); ++i) {
      const SeedState seed = dem.seed_state(i);
      if (std::abs(dot(seed.centre, downhill)) < 2 * d)
        gathered.profile.add(dot(seed.centre, normal), dot(seed.velocity, downhill));
    }
  };

  s.columns = {{"revolutions"},
               {"dynamic angle", "deg"},
               {"angle in the middle", "deg"},
               {"centre of mass angle", "deg"}};
  if (diaphragm)
    for (const double cell : cells) {
      s.columns.push_back({"lacey view " + printed_number(1e3 * cell) + " mm", "%"});
      s.columns.push_back({"lacey 3d " + printed_number(1e3 * cell) + " mm", "%"});
    }
  s.observe = [this](const Dem& dem, double time) {
    const BedContour bed = measure_contour(dem);
    std::vector<double> row = {revolutions_at(time), bed.angle / degree, bed.middle_angle / degree,
                               centre_of_mass_angle(dem) / degree};
    if (diaphragm)
      for (const double cell : cells)
        for (const bool view : {true, false}) row.push_back(100 * measure_mixing(dem, cell, view).index);
    return row;
  };
  s.save = [&gathered](std::ostream& out) {
    write_binary(out, gathered.profile.sum);
    write_binary(out, gathered.profile.count);
    write_binary(out, gathered.last_revolutions);
  };
  s.load = [&gathered](std::istream& in) {
    read_binary(in, gathered.profile.sum);
    read_binary(in, gathered.profile.count);
    read_binary(in, gathered.last_revolutions);
  };
  s.not_of_filling = {"Drum/Speed",       "Drum/Revolutions",  "Drum/Lacey cells",  "Drum/Lacey count",
                      "Drum/Pictures at", "Drum/Plateau from", "Drum/Profile from", "Drum/Measurements"};
  return s;
}

BedContour RotatingDrum::measure_contour(const Dem& dem) const {
  return bed_contour(spheres_from(front, dem), 0, 0, radius, 0.25 * granular.model.diameter, contour);
}

double RotatingDrum::centre_of_mass_angle(const Dem& dem) const {
  std::vector<Vec3> positions;
  dem.positions(positions);
  Vec3 sum;
  for (std::size_t i = 0; i < positions.size(); ++i) sum += dem.masses()[i] * positions[i];
  return std::atan2(sum.x, -sum.z);
}

LaceyIndex RotatingDrum::measure_mixing(const Dem& dem, double cell, bool view) const {
  const Vec3 edge{cell, view ? 0 : cell, cell};
  if (lacey_count == "sub-spheres") {
    std::vector<Vec3> centres;
    dem.positions(centres);
    std::vector<bool> coloured;
    for (int i = 0; i < dem.n_seeds(); ++i)
      coloured.insert(coloured.end(), dem.first_sphere(i + 1) - dem.first_sphere(i), dem.seed_group(i) == 1);
    return lacey_index(mixing_cells(centres, coloured, edge));
  }
  std::vector<double> share;
  if (view) share = visible_shares(seeds_from(front, dem), granular.model.diameter / 16);
  std::vector<Vec3> centres;
  std::vector<bool> coloured;
  for (int i = 0; i < dem.n_seeds(); ++i) {
    if (view && share[i] < seen_share) continue;
    centres.push_back(dem.seed_state(i).centre);
    coloured.push_back(dem.seed_group(i) == 1);
  }
  return lacey_index(mixing_cells(centres, coloured, edge));
}

SeedPicture RotatingDrum::picture(const Dem& dem, const std::string& title, const BedContour* bed) const {
  SeedPicture p;
  p.title = title;
  const double edge = 1.06 * radius;
  p.window = {-edge, -edge, edge, edge};
  p.width = 330;
  p.discs = seeds_from(front, dem);
  p.group = groups_of(dem);
  PictureLine circle;
  circle.width = 3;
  for (int i = 0; i <= 120; ++i) {
    circle.x.push_back(radius * std::cos(i * M_PI / 60));
    circle.y.push_back(radius * std::sin(i * M_PI / 60));
  }
  p.behind = {circle};
  if (bed) {
    PictureLine surface;
    surface.colour = "#000", surface.width = 3, surface.dash = "8 5";
    for (int i = 0; i <= 40; ++i) {
      surface.x.push_back(bed->middle + bed->half * (i / 20.0 - 1));
      surface.y.push_back(bed->surface(surface.x.back()));
    }
    p.before = {surface};
  }
  return p;
}

}  // namespace seedflow
