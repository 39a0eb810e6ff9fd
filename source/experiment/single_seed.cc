#include "seedflow/experiment/single_seed.h"

#include <algorithm>
#include <cmath>
#include <memory>

namespace seedflow {

namespace {

/// The scalars of section/entry, once, for declaring and for access by path.
struct Scalar {
  const char *section, *name;
  double SingleSeedParameters::*member;
  const char* unit;
  Range range;
  const char* doc;
};

const std::vector<Scalar>& scalars() {
  using P = SingleSeedParameters;
  static const std::vector<Scalar> all = {
      {"Seeds", "Release time", &P::release_time, "s", Range::any(),
       "When the seed is let go, on the clock of the measurements."},
      {"Air", "Density", &P::density, "kg/m3", Range::positive(), "Density of the fluid."},
      {"Air", "Dynamic viscosity", &P::viscosity, "Pa s", Range::positive(), "Of the fluid."},
      {"Air",
       "Void fraction",
       &P::void_fraction,
       "1",
       {0, 1, true},
       "Of the suspension the seed is part of."},
      {"Vessel", "Tube diameter", &P::tube_diameter, "m", Range::non_negative(),
       "Inner diameter of a tube along whose axis the seed moves; 0: none."},
      {"Run", "End time", &P::end_time, "s", Range::positive(), "Simulated time."},
      {"Run", "Time step", &P::time_step, "s", Range::positive(), "Longest step of the motion."},
      {"Run", "Series interval", &P::series_interval, "s", Range::positive(), "Between rows of seeds.csv."}};
  return all;
}

struct Vector {
  const char *section, *name;
  Vec3 SingleSeedParameters::*member;
  const char *unit, *doc;
};

const std::vector<Vector>& vectors() {
  using P = SingleSeedParameters;
  static const std::vector<Vector> all = {
      {"Seeds", "Position", &P::position, "m", "Of the centre at the release."},
      {"Seeds", "Velocity", &P::velocity, "m/s", "At the release."},
      {"Seeds", "Spin", &P::spin, "rad/s", "Angular velocity at the release."},
      {"Seeds motion", "Gravity", &P::gravity, "m/s2", "Acceleration of gravity."},
      {"Vessel", "Lower corner", &P::lower, "m", "Of the box whose faces Walls names."},
      {"Vessel", "Upper corner", &P::upper, "m", "Of the box whose faces Walls names."}};
  return all;
}

const std::vector<std::string>& face_names() {
  static const std::vector<std::string> names = {"x low", "x high", "y low", "y high", "z low", "z high"};
  return names;
}

void declare_section(SingleSeedParameters& s, Parameters& p, const std::string& section) {
  for (const Scalar& x : scalars())
    if (x.section == section) p.number(x.name, s.*x.member, x.unit, x.range, x.doc);
  for (const Vector& x : vectors())
    if (x.section == section) p.vector(x.name, s.*x.member, x.unit, Range::any(), x.doc);
}

/// "Effects/NAME/ENTRY" split; empty if the path is another one.
std::pair<std::string, std::string> effect_entry(const std::string& path) {
  const std::string head = "Effects/";
  if (path.compare(0, head.size(), head) != 0) return {};
  const std::size_t slash = path.find('/', head.size());
  if (slash == std::string::npos) return {};
  return {path.substr(head.size(), slash - head.size()), path.substr(slash + 1)};
}

[[noreturn]] void no_number(const std::string& path) {
  throw InputError("\"" + path + "\" is no number of the experiment single seed that can be varied.");
}

PrescribedFlow flow_of(const SingleSeedParameters& p) {
  PrescribedFlow flow;
  flow.density = p.density;
  flow.viscosity = p.viscosity;
  flow.gravity = p.gravity;
  flow.void_fraction = p.void_fraction;
  if (p.tube_diameter > 0) flow.tube_diameter = p.tube_diameter;
  for (const std::string& face : p.walls) {
    const auto f = std::find(face_names().begin(), face_names().end(), face) - face_names().begin();
    WallPlane wall;
    wall.point = f % 2 == 0 ? p.lower : p.upper;
    wall.normal[static_cast<int>(f / 2)] = f % 2 == 0 ? 1 : -1;
    flow.walls.push_back(wall);
  }
  const bool rest = std::all_of(p.flow.velocity.begin(), p.flow.velocity.end(),
                                [](const std::string& text) { return text == "0"; });
  if (!rest) {
    const auto air = std::make_shared<PrescribedAir>(p.flow, p.density, p.viscosity);
    flow.velocity = [air](const Vec3& x, double t) { return air->velocity(x, t); };
  }
  return flow;
}

}  // namespace

void SingleSeedParameters::declare(Parameters& p) {
  declare_experiment_name(p, name);
  {
    const auto section = p.section("Seeds", "The seed, a body described by its volume-equivalent sphere.");
    p.number("Diameter", seed.diameter, "m", Range::positive(), "Volume-equivalent diameter.");
    p.number("Density", seed.density, "kg/m3", Range::positive(), "Mass over volume.");
    p.number("Sphericity", seed.sphericity, "1", {0, 1, true},
             "Surface of the equal-volume sphere over the seed's surface.");
    declare_section(*this, p, "Seeds");
  }
  {
    const auto section = p.section("Seeds motion", "");
    declare_section(*this, p, "Seeds motion");
  }
  {
    const auto section = p.section("Air", "The fluid and its flow, which the seed does not change.");
    declare_section(*this, p, "Air");
    flow.declare(p);
  }
  {
    const auto section = p.section("Vessel", "Walls that effects know of; the seed does not touch them.");
    declare_section(*this, p, "Vessel");
    p.choices("Walls", walls, face_names(), "Faces of the box that are there.");
  }
  {
    const auto section = p.section("Run", "Times and output.");
    declare_section(*this, p, "Run");
  }
  effects.declare(p);
}

void SingleSeedParameters::check(const Parameters& p) {
  effects.prepare();
  if (tube_diameter > 0 && tube_diameter <= seed.diameter)
    p.reject("Vessel/Tube diameter", "the seed does not fit", "use a wider tube or a smaller seed");
  for (int d = 0; d < 3; ++d)
    if (!(lower[d] < upper[d]))
      p.reject("Vessel/Upper corner", "it must lie above Lower corner in every direction",
               "give the box a volume");
}

double* SingleSeedParameters::number(const std::string& path) {
  if (path == "Seeds/Diameter") return &seed.diameter;
  if (path == "Seeds/Density") return &seed.density;
  if (path == "Seeds/Sphericity") return &seed.sphericity;
  for (const Scalar& x : scalars())
    if (path == std::string(x.section) + "/" + x.name) return &(this->*x.member);
  for (const Vector& x : vectors())
    for (int d = 0; d < 3; ++d)
      if (path == std::string(x.section) + "/" + x.name + " " + "xyz"[d]) return &(this->*x.member)[d];
  return nullptr;
}

double SingleSeedParameters::value(const std::string& path) const {
  const auto [effect, entry] = effect_entry(path);
  if (!effect.empty())
    return entry == "Strength" ? effects[effect].settings().strength : effects[effect].number(entry);
  const double* found = const_cast<SingleSeedParameters*>(this)->number(path);
  if (!found) no_number(path);
  return *found;
}

void SingleSeedParameters::set(const std::string& path, double value) {
  const auto [effect, entry] = effect_entry(path);
  if (!effect.empty()) {
    if (entry == "Strength")
      effects[effect].set_strength(value);
    else
      effects[effect].set_number(entry, value);
    return;
  }
  double* found = number(path);
  if (!found) no_number(path);
  *found = value;
}

std::vector<SingleSeedSample> run_single_seed(const SingleSeedParameters& p, const std::vector<double>& times,
                                              std::vector<std::string>* idle,
                                              const std::function<void(const EffectSet&)>& look) {
  const PrescribedFlow flow = flow_of(p);
  EffectSet effects = p.effects;
  SingleBodyState start;
  start.time = p.release_time;
  start.position = p.position;
  start.velocity = p.velocity;
  start.angular_velocity = p.spin;
  SingleBody body(p.seed, flow, effects, start);
  std::vector<SingleSeedSample> samples;
  samples.reserve(times.size());
  for (const double time : times) {
    if (time > body.state().time) body.run({time}, p.time_step);
    samples.push_back({body.state(), body.flow_at(body.state(), body.state().time, p.time_step)});
  }
  if (idle) *idle = effects.idle();
  if (look) look(effects);
  return samples;
}

double single_seed_drag_coefficient(const SingleSeedParameters& p, double reynolds) {
  SingleSeedParameters held = p;
  held.gravity = {};
  PrescribedFlow flow = flow_of(held);
  const double d = p.seed.diameter, speed = reynolds * p.viscosity / (p.density * d);
  flow.velocity = [speed](const Vec3&, double) { return Vec3{speed, 0, 0}; };
  // Memory is of past changes, and a steady stream has none.
  for (Effect& effect : held.effects.all())
    if (effect.record().has_memory) effect.set_strength(0);
  SingleBodyState at;
  at.position = p.position;
  const SingleBody body(p.seed, flow, held.effects, at);
  const FlowAtBody seen = body.flow_at(at, 0, 1);
  BodyForce force;
  held.effects.add(seen, force);
  return (force.drag_coefficient * speed + force.force.x) / (M_PI / 8 * p.density * d * d * speed * speed);
}

}  // namespace seedflow
