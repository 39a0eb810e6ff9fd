#include "seedflow/experiment/metering.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "seedflow/base/binary.h"
#include "seedflow/base/error.h"
#include "seedflow/base/together.h"
#include "seedflow/experiment/granular_report.h"
#include "seedflow/output/folder.h"
#include "seedflow/output/svg.h"

namespace seedflow {

namespace {

constexpr double degree = M_PI / 180;

/// Groups of seeds, by colour: in the pool, carried alone, carried with others, laid.
enum Group { in_pool = 0, alone = 1, with_others = 2, laid = 3 };

}  // namespace

Metering::Metering() {
  granular.mass = 800 * 4.490e-5;
  granular.end_time = 0.8;
  granular.dem.gravity = {0, -9.81, 0};
}

void Metering::declare(Parameters& p) {
  granular.declare(p);
  device.declare(p);
  surfaces.declare(p);
  {
    const auto section = p.section("Metering", "Motion, what stands in front of the disc, what is drawn.");
    p.number("Speed", speed, "rad/s", Range::positive(), "Of the disc. The paper's: 30 rpm.");
    p.number("Forward speed", forward_speed, "m/s", Range::positive(),
             "Of the machine over the ground. The paper's: 10.8 km/h.");
    p.number("Chamber from", parts.chamber_from, "rad", Range::any(),
             "Angle at which the seed chamber's outer wall begins, with a divider that keeps the seeds in.");
    p.number("Chamber to", parts.chamber_to, "rad", Range::any(), "Angle at which it ends.");
    p.choice("Blade", parts.blade_sides, {"both", "outer", "inner", "none"},
             "The cleaning blade: outside the circle of holes, inside, on both sides, or none. Between two "
             "sides that draw together, seeds in pairs can wedge and sweep off all that follow.");
    p.number("Blade angle", parts.blade_angle, "rad", Range::any(), "Of its first tooth.");
    p.number("Blade length", parts.blade_length, "rad", Range::positive(), "Along the circle of holes.");
    p.integer("Teeth", parts.teeth, Range::between(1, 100), "Of each side of the blade.");
    p.number("Tooth depth", parts.tooth_depth, "m", Range::positive(), "Of each tooth.");
    p.number("Passage at the first tooth", parts.passage_in, "m", Range::positive(),
             "From the circle of holes to the tip of the tooth.");
    p.number("Passage at the last tooth", parts.passage_out, "m", Range::positive(),
             "The same; a little more than a seed's radius lets single seeds pass.");
    p.number("Blade clearance", parts.blade_clearance, "m", Range::any(), "Between disc and blade.");
    p.number("Blade height", parts.blade_height, "m", Range::positive(), "Along the axis.");
    p.number("Tube position", parts.tube_position, "m", Range::any(),
             "x of the middle of the guide tube below the unloading point.");
    p.number("Tube width", parts.tube_width, "m", Range::positive(), "Of the guide tube.");
    p.number("Tube top", parts.tube_top, "m", Range::any(), "Height (y) at which it begins.");
    p.number(
        "Tube end", parts.tube_end, "m", Range::any(),
        "Height (y) at which it ends; the times at which seeds pass it give their spacing on the ground.");
    p.number("Floor", parts.floor, "m", Range::any(), "Height (y) of the floor of the catch bin.");
    p.text("Disc material", disc_material, "One of Materials/Names.");
    p.text("Housing material", housing_material, "Of everything that stands still.");
    p.numbers("Pictures at", picture_at, "s", Range::non_negative(), "Times of pictures.");
  }
  suction.declare(p);
  {
    const auto section = p.section("Air", "");
    p.choice(
        "Model", air_model, {"hole sinks", "resolved"},
        "hole sinks: every hole is an opening with its potential flow, in milliseconds and without a mesh. "
        "resolved: the flow in seed chamber, holes and vacuum chamber is computed on a mesh, with the "
        "seeds.");
  }
  {
    const auto section = p.section("Coupling", "How the air sees the seeds.");
    p.choice("Drag on", coupling.drag_on, {"seed", "sub-sphere"},
             "What is dragged as one body: the whole seed, or every sub-sphere as if alone (the paper).");
  }
  resolved.declare(p);
  effects.declare(p);
}

void Metering::check(const Parameters& p) {
  granular.check(p, {"Metering/Disc material", "Metering/Housing material"});
  device.check(p);
  surfaces.check(device, p);
  suction.check(p, air_model == "resolved" ? 1e-3 : 5e-4);
  effects.prepare();
  if (air_model == "resolved") check_resolved(p);
  const double d = granular.model.diameter;
  if (device.hole_diameter >= d)
    p.reject("Device/Hole diameter", "the seeds would be drawn through the holes",
             "use less than Seeds/Diameter");
  if (parts.blade_clearance <= 0)
    p.reject("Metering/Blade clearance", "the blade would cut into the disc", "use a positive clearance");
  if (suction.vibration_strength * suction.vibration_amplitude >= parts.blade_clearance &&
      (parts.blade_sides != "none" || !surfaces.blade.empty()))
    p.reject("Effects/Disc vibration/Amplitude", "the shaking disc would strike the blade",
             "use less than Metering/Blade clearance, or a larger clearance");
  if (parts.blade_clearance + parts.blade_height > device.chamber_depth)
    p.reject("Metering/Blade height", "the blade reaches through the chamber's front cover",
             "use less than Device/Chamber depth minus the clearance");
  if (parts.passage_out > parts.passage_in)
    p.reject("Metering/Passage at the last tooth", "the passage widens along the blade",
             "use at most the passage at the first tooth");
  const double back = parts.passage_in + parts.tooth_depth;
  if ((parts.blade_sides == "both" || parts.blade_sides == "inner") &&
      (device.pitch_radius - back - 2e-3 <= device.chamber_inner_radius))
    p.reject("Metering/Passage at the first tooth", "the inner blade reaches into the hub",
             "use a smaller passage or tooth depth");
  if (!(parts.chamber_to > parts.chamber_from) || parts.chamber_to - parts.chamber_from >= 2 * M_PI)
    p.reject("Metering/Chamber to", "the chamber's wall has no extent",
             "let it end after Metering/Chamber from, in the sense of the rotation");
  const SeedingStations s = stations();
  if (parts.blade_sides != "none" && !(s.pool < parts.blade_angle && s.cleaned < s.unloaded))
    p.reject("Metering/Blade angle",
             "the blade does not stand between the pool (-90 deg) and the end of the vacuum",
             "move the blade, or Device/Vacuum to");
  if (!(s.carried < s.unloaded))
    p.reject("Device/Vacuum to", "the vacuum ends before the seeds leave the pool", "let it end later");
  // Where a seed that is let go falls past the top of the tube.
  const double a = device.vacuum_to, v = speed * device.pitch_radius;
  const double x0 = device.pitch_radius * std::cos(a), y0 = device.pitch_radius * std::sin(a);
  const double vx = -v * std::sin(a), vy = v * std::cos(a), g = norm(granular.dem.gravity);
  const double fall = (vy + std::sqrt(std::max(0.0, vy * vy + 2 * g * (y0 - parts.tube_top)))) / g;
  if (std::abs(x0 + vx * fall - parts.tube_position) > 0.5 * parts.tube_width)
    p.reject("Metering/Tube position",
             "seeds that are let go where the vacuum ends fall beside the tube, at x = " +
                 printed_number(1e3 * (x0 + vx * fall)) + " mm",
             "move the tube there, or Device/Vacuum to");
  if (!(parts.floor < parts.tube_end && parts.tube_end < parts.tube_top))
    p.reject("Metering/Tube end", "the tube must end between its top and the floor",
             "choose Tube top > Tube end > Floor");
  const Vec3 gravity = granular.dem.gravity;
  if (gravity.x != 0 || gravity.z != 0 || !(gravity.y < 0))
    p.reject("Seeds motion/Gravity", "the disc stands upright and -90 deg is its bottom",
             "write it as 0, -9.81, 0");
}

SeedingStations Metering::stations() const {
  SeedingStations s;
  s.pool = -90 * degree;
  s.carried = parts.blade_angle - 3 * degree;
  s.cleaned = parts.blade_angle + (parts.blade_sides == "none" ? 0 : parts.blade_length) + 3 * degree;
  s.unloaded = device.vacuum_to - 4 * degree;
  return s;
}

FillingRoom Metering::room() const {
  const double r = device.chamber_outer_radius;
  return {
      "seed chamber", {r * std::cos(parts.chamber_from), -r, -device.chamber_depth}, {0.9 * r, 0.3 * r, 0}};
}

Metering::Gathered::Gathered(const Metering& m, EffectSet& all_effects)
    : record(m.device, m.stations(), 0.85 * m.granular.model.diameter, m.parts.tube_end,
             m.granular.dem.gravity) {
  if (m.air_model == "resolved")
    resolved.emplace(m.resolved, m.suction, m.device, m.coupling, disc_wall, all_effects,
                     m.granular.dem.gravity, MPI_COMM_WORLD);
  else
    sinks.emplace(m.suction, m.device, m.coupling, disc_wall, 0.5 * m.granular.model.diameter, all_effects,
                  m.granular.dem.gravity);
}

Vec3 Metering::Gathered::advance(Dem& dem, double duration) {
  return sinks ? sinks->advance(dem, duration) : resolved->advance(dem, duration);
}
const std::vector<SeedLoad>& Metering::Gathered::seed_loads() const {
  return sinks ? sinks->seed_loads() : resolved->seed_loads();
}
const SuctionBalance& Metering::Gathered::chamber() const {
  return sinks ? sinks->chamber() : resolved->chamber();
}
double Metering::Gathered::air_drawn() const {
  return sinks ? sinks->air_drawn() : resolved->air_drawn();
}
double Metering::Gathered::work() const {
  return sinks ? sinks->work() : resolved->work();
}

void Metering::check_resolved(const Parameters& p) const {
  const double travel = suction.vibration_strength * suction.vibration_amplitude;
  const bool own_mesh = !resolved.mesh.file.empty();
  if (own_mesh) try {
      check_device_mesh(device, resolved.mesh, MPI_COMM_SELF);
    } catch (const InputError& error) {
      p.reject("Device mesh/File", error.what(), "see doc/own_device.md");
    }
  const double cell =
      travel > 0 && own_mesh ? DeviceMesh(device, resolved.mesh).face_cell() : resolved.mesh.face_cell;
  if (travel > 0.5 * cell)
    p.reject(
        "Effects/Disc vibration/Amplitude",
        "the mesh of the computed air does not shake with the disc, which is right only for a travel below "
        "half a cell at the disc's face",
        "use a smaller one, or Air/Model = hole sinks");
  if (!suction.blocking)
    p.reject("Suction/Seeds block holes", "seeds always block the holes of the computed air",
             "set it to true, or Air/Model = hole sinks");
}

void Metering::write_air(Gathered& gathered, double time, const std::filesystem::path& output) const {
  if (!gathered.resolved || granular.field_interval <= 0 || output.empty()) return;
  const long now = static_cast<long>(std::floor(time / granular.field_interval + 1e-6));
  if (now < gathered.next_field) return;
  const std::string file = gathered.resolved->write(output.string(), "air", static_cast<unsigned int>(now));
  gathered.next_field = now + 1;
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  together(MPI_COMM_WORLD, [&] {
    if (rank != 0 || file.empty()) return;
    if (!gathered.air_files && now > 1)
      gathered.air_files.emplace(output / "air.pvd", time - 1e-9);
    else if (!gathered.air_files)
      gathered.air_files.emplace(output / "air.pvd");
    gathered.air_files->add(time, std::filesystem::path(file).filename().string());
  });
}

void Metering::Gathered::save_air(std::ostream& out) const {
  std::ostringstream state;
  if (sinks) sinks->save(state);
  if (resolved) resolved->save(state);
  const std::string text = state.str();
  write_binary(out, resolved.has_value());
  write_binary(out, std::vector<char>(text.begin(), text.end()));
}

void Metering::Gathered::load_air(std::istream& in) {
  bool of_resolved = false;
  std::vector<char> text;
  read_binary(in, of_resolved);
  read_binary(in, text);
  // Of the other model, only a settled filling is read: its air has not begun.
  if (of_resolved != resolved.has_value()) return;
  std::istringstream state(std::string(text.begin(), text.end()));
  if (sinks) sinks->load(state);
  if (resolved) resolved->load(state);
}

GranularScene Metering::scene(Gathered& gathered, const std::filesystem::path& folder,
                              const std::filesystem::path& output) const {
  GranularScene s;
  const double d = granular.model.diameter, room_edge = device.disc_radius + 3 * d;
  s.low = {-room_edge - d, parts.floor - d, -device.chamber_depth - d};
  s.high = {room_edge + d, room_edge + d, device.thickness + d};
  s.walls = walls();
  s.rooms = {room()};
  s.begin = [this, &gathered](Dem& dem, double start) {
    WallMotion motion = WallMotion::rotation({0, 0, 0}, {0, 0, speed});
    motion.angle.start = start;
    if (suction.vibration_strength > 0) {
      motion.direction = {0, 0, 1};
      motion.displacement.kind = TimeLaw::Kind::sinusoid;
      motion.displacement.amplitude = suction.vibration_strength * suction.vibration_amplitude;
      motion.displacement.frequency = suction.vibration_frequency;
      motion.displacement.start = start;
    }
    dem.wall(disc_wall).motion = motion;
    dem.set_wall_active(filling_wall, false);
    gathered.start = start;
  };
  s.advance = [&gathered](Dem& dem, double duration) { return gathered.advance(dem, duration); };
  s.after_interval = [this, &gathered, folder, output](Dem& dem, double time) {
    gathered.record.update(dem, gathered.seed_loads(), time, turned_at(time), speed);
    gathered.suction_sum += gathered.chamber().drop;
    gathered.flow_sum += gathered.chamber().flow;
    ++gathered.intervals;
    write_air(gathered, time, output);
    const std::vector<int>& carrier = gathered.record.hole_of_seed();
    for (int i = 0; i < dem.n_seeds(); ++i) {
      const int hole = carrier[i];
      const Vec3 x = dem.seed_state(i).centre;
      const bool outside = x.x < device.chamber_outer_radius * std::cos(parts.chamber_from) && hole < 0;
      dem.set_group(i, outside || dem.seed_group(i) == laid              ? laid
                       : hole < 0 || std::atan2(x.y, x.x) < -30 * degree ? in_pool
                       : gathered.record.carried_now()[hole] > 1         ? with_others
                                                                         : alone);
    }
    for (const double at : picture_at)
      if (gathered.last_time < at && at <= time + 1e-9 && !folder.empty())
        write_file_atomically(folder / ("device_" + printed_number(at) + "s.svg"),
                              picture(dem, turned_at(time), printed_number(at) + " s").svg());
    gathered.last_time = time + 1e-9;
  };
  s.columns = {{"disc angle", "rad"},           {"vacuum", "Pa"},          {"air flow", "m3/s"},
               {"holes with one seed"},         {"holes with more seeds"}, {"seeds laid"},
               {"largest pressure force", "N"}, {"largest drag", "N"}};
  s.observe = [this, &gathered](const Dem&, double time) {
    int one = 0, more = 0;
    for (const int n : gathered.record.carried_now()) one += n == 1, more += n > 1;
    double pressure = 0, drag = 0;
    for (const SeedLoad& load : gathered.seed_loads())
      pressure = std::max(pressure, norm(load.pressure)), drag = std::max(drag, norm(load.drag));
    return std::vector<double>{turned_at(time),
                               gathered.chamber().drop,
                               gathered.chamber().flow,
                               1.0 * one,
                               1.0 * more,
                               1.0 * static_cast<double>(gathered.record.landing_times().size()),
                               pressure,
                               drag};
  };
  s.save = [&gathered](std::ostream& out) {
    gathered.save_air(out);
    gathered.record.save(out);
    write_binary(out, gathered.last_time);
    write_binary(out, gathered.next_field);
    write_binary(out, gathered.suction_sum);
    write_binary(out, gathered.flow_sum);
    write_binary(out, gathered.intervals);
  };
  s.load = [&gathered](std::istream& in) {
    gathered.load_air(in);
    gathered.record.load(in);
    read_binary(in, gathered.last_time);
    read_binary(in, gathered.next_field);
    read_binary(in, gathered.suction_sum);
    read_binary(in, gathered.flow_sum);
    read_binary(in, gathered.intervals);
  };
  s.not_of_filling = {"Metering/Speed",
                      "Metering/Forward speed",
                      "Metering/Pictures at",
                      "Suction/",
                      "Air/",
                      "Effects/",
                      "Coupling/",
                      "Device mesh/",
                      "Device/Vacuum from",
                      "Device/Vacuum to",
                      "Device/Hole diameter",
                      "Device/Chamfer",
                      "Device/First angle",
                      "Device/Drilled"};
  return s;
}

}  // namespace seedflow
