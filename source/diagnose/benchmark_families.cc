#include <cmath>

#include "seedflow/base/error.h"
#include "seedflow/base/nearest_name.h"
#include "seedflow/diagnose/benchmark.h"
#include "seedflow/truth/truth_laws.h"

namespace seedflow {

namespace {

struct Substances {
  double diameter, density, viscosity, fluid_density = 1000;  ///< [m], [kg/m3], [Pa s]
};

TruthSeed seed_of(const Substances& s) {
  TruthSeed seed;
  seed.diameter = s.diameter, seed.density = s.density;
  seed.viscosity = s.viscosity, seed.fluid_density = s.fluid_density;
  return seed;
}

double terminal_speed(const TruthSeed& s) {
  const double stokes =
      std::abs(s.density - s.fluid_density) * 9.81 * s.diameter * s.diameter / (18 * s.viscosity);
  double v = stokes;
  for (int i = 0; i < 60; ++i)
    v = 0.5 * (v + stokes / truth_drag(s.fluid_density * s.diameter * v / s.viscosity));
  return v;
}

/// Time scale on which the seed reaches its terminal speed [s].
double response_time(const TruthSeed& s) {
  const double net = std::abs(s.density - s.fluid_density);
  if (net < 1e-9) return (s.density + 0.5 * s.fluid_density) * s.diameter * s.diameter / (18 * s.viscosity);
  return (s.density + 0.5 * s.fluid_density) / net * terminal_speed(s) / 9.81;
}

/// The last two of the conditions are held out, all are named, and a run has 200 steps.
BenchmarkFamily finished(BenchmarkFamily family) {
  const std::size_t n = family.conditions.size();
  const auto finish = [](BenchmarkCondition& c, const std::string& name) {
    c.name = name;
    c.time_step = c.end_time / 200;
  };
  for (std::size_t i = 0; i < n; ++i) {
    finish(family.conditions[i], "run " + std::to_string(i + 1));
    family.conditions[i].held_out = i + 2 >= n;
  }
  for (std::size_t i = 0; i < family.possible.size(); ++i)
    finish(family.possible[i], "further run " + std::to_string(i + 1));
  return family;
}

/// Released from rest in a liquid at rest.
BenchmarkFamily released(const std::string& name, const std::vector<Substances>& substances) {
  BenchmarkFamily f{name, {"velocity"}, 25, {}, {}};
  for (const Substances& s : substances) {
    BenchmarkCondition c;
    c.seed = seed_of(s);
    c.end_time = 5 * response_time(c.seed);
    f.conditions.push_back(c);
  }
  return finished(f);
}

/// Reynolds numbers from 2.5 to 22.
BenchmarkFamily release() {
  return released("release", {{4e-3, 1340, 0.02},
                              {4e-3, 2500, 0.1},
                              {3e-3, 1200, 0.01},
                              {6e-3, 1340, 0.05},
                              {5e-3, 1100, 0.02},
                              {6e-3, 7800, 0.5},
                              {3e-3, 1340, 0.01},
                              {5e-3, 1800, 0.06}});
}

/// Reynolds numbers from 0.5 to 200.
BenchmarkFamily wide_release() {
  return released("wide release", {{2e-3, 1340, 0.05},
                                   {2e-3, 1340, 0.02},
                                   {3e-3, 1340, 0.01},
                                   {3e-3, 2500, 0.005},
                                   {4e-3, 7800, 0.005},
                                   {3e-3, 7800, 0.02},
                                   {5e-3, 1800, 0.06},
                                   {4e-3, 1340, 0.005}});
}

/// Settling while the liquid swings sideways.
BenchmarkFamily oscillating() {
  BenchmarkFamily f{"oscillating", {"velocity x", "velocity z"}, 20, {}, {}};
  const double beat[] = {1, 2, 3, 1.5, 1.5, 2.5, 1.2, 2};  // angular frequency times response time
  int i = 0;
  for (const Substances& s : {Substances{4e-3, 1340, 0.02},
                              {4e-3, 1050, 0.02},
                              {3e-3, 1100, 0.02},
                              {4e-3, 2500, 0.1},
                              {5e-3, 400, 0.1},
                              {6e-3, 1340, 0.2},
                              {3e-3, 1080, 0.02},
                              {5e-3, 1200, 0.06}}) {
    BenchmarkCondition c;
    c.seed = seed_of(s);
    c.seed.flow.frequency = beat[i++] / response_time(c.seed);
    c.seed.flow.amplitude = {0.05, 0, 0};
    c.end_time = 1.5 * 2 * M_PI / c.seed.flow.frequency;
    f.conditions.push_back(c);
  }
  return finished(f);
}

/// Settling or rising along the streamlines of a plain shear.
BenchmarkFamily sheared(const std::string& name,
                        const std::vector<std::pair<double, Substances>>& rates_and_substances) {
  BenchmarkFamily f{name, {"position x", "velocity z"}, 20, {}, {}};
  for (const auto& [rate, substances] : rates_and_substances) {
    BenchmarkCondition c;
    c.seed = seed_of(substances);
    c.seed.flow.shear = rate;
    c.end_time = 12 / rate;
    f.conditions.push_back(c);
  }
  return finished(f);
}

/// Shear Reynolds numbers from 1 to 11.
BenchmarkFamily shear() {
  return sheared("shear", {{40, {1e-3, 1200, 0.01}},
                           {10, {1e-3, 1100, 0.01}},
                           {60, {2e-3, 1100, 0.04}},
                           {80, {1e-3, 800, 0.01}},
                           {30, {2e-3, 1200, 0.05}},
                           {100, {1.5e-3, 1150, 0.02}},
                           {20, {1e-3, 1150, 0.015}},
                           {50, {1.5e-3, 900, 0.02}}});
}

/// Re from 0.15 to 0.3 and shear d G/(2 slip) from 0.2 to 0.4: the lift in shear is known there from small-Re
/// theory and from computations at finite Re alike, and they agree within a tenth.
BenchmarkFamily slow_shear() {
  return sheared("slow shear", {{2.1, {3e-3, 1200, 0.1}},
                                {2.0, {2e-3, 1200, 0.06}},
                                {1.3, {4e-3, 1100, 0.12}},
                                {1.2, {3e-3, 850, 0.1}},
                                {1.7, {4e-3, 1340, 0.25}},
                                {1.8, {2e-3, 1340, 0.08}},
                                {0.9, {5e-3, 1100, 0.2}},
                                {1.4, {3e-3, 1150, 0.1}}});
}

/// Released spinning in a liquid at rest.
BenchmarkFamily spinning() {
  BenchmarkFamily f{"spinning", {"position x", "spin y", "velocity z"}, 15, {}, {}};
  const double spin[] = {300, -150, 250, 200, -300, 150, 250, -200};
  int i = 0;
  for (const Substances& s : {Substances{3e-3, 7800, 0.1},
                              {3e-3, 2500, 0.06},
                              {2e-3, 7800, 0.06},
                              {4e-3, 2500, 0.12},
                              {3e-3, 4000, 0.1},
                              {4e-3, 2500, 0.1},
                              {2.5e-3, 7800, 0.08},
                              {3.5e-3, 4000, 0.1}}) {
    BenchmarkCondition c;
    c.seed = seed_of(s);
    c.seed.spin = {0, spin[i++], 0};
    c.seed.velocity = {0, 0, -terminal_speed(c.seed)};
    c.end_time =
        3 * s.density * s.diameter * s.diameter / (60 * s.viscosity);  // spins down with I/(pi mu d^3)
    f.conditions.push_back(c);
  }
  return finished(f);
}

/// Towards a floor and along a wall.
BenchmarkFamily walls() {
  BenchmarkFamily f{"walls", {"position x", "velocity z"}, 20, {}, {}};
  const auto add = [&](const Substances& s, bool floor, double gap, double travel) {
    BenchmarkCondition c;
    c.seed = seed_of(s);
    const double start = (0.5 + gap) * s.diameter;
    c.lower = {0, -1, 0}, c.upper = {1, 1, 1};
    c.seed.position = floor ? Vec3{0.5, 0, start} : Vec3{start, 0, 0.5};
    c.faces = {floor ? "z low" : "x low"};
    c.seed.walls = {floor ? TruthWall{{0, 0, 0}, {0, 0, 1}} : TruthWall{{0, 0, 0}, {1, 0, 0}}};
    c.seed.velocity = {0, 0, -0.5 * terminal_speed(c.seed)};
    c.end_time = travel * s.diameter / terminal_speed(c.seed);
    f.conditions.push_back(c);
  };
  add({4e-3, 1340, 0.3}, true, 1.5, 1.6);
  add({4e-3, 1340, 0.2}, false, 0.2, 60);
  add({3e-3, 1340, 0.12}, false, 0.5, 60);
  add({3e-3, 2500, 0.5}, true, 1.0, 1.2);
  add({4e-3, 1200, 0.15}, false, 0.1, 50);
  add({2e-3, 2500, 0.2}, false, 0.3, 60);
  add({4e-3, 1200, 0.3}, true, 2.0, 2.0);
  add({3e-3, 1200, 0.1}, false, 0.3, 60);
  return finished(f);
}

/// Bodies in suspensions, in tubes of several widths.
struct Vessel {
  double tube;  ///< d/D
  double void_fraction, sphericity;
};
BenchmarkFamily vessels(const std::string& name, const std::vector<Vessel>& vessels,
                        const std::vector<Vessel>& possible) {
  BenchmarkFamily f{name, {"velocity"}, 20, {}, {}};
  const Substances substances[] = {{4e-3, 1340, 0.3}, {3e-3, 2500, 0.4}, {4e-3, 1200, 0.1},
                                   {5e-3, 1340, 0.4}, {3e-3, 1340, 0.2}, {4e-3, 2500, 0.8},
                                   {5e-3, 1200, 0.3}, {4e-3, 1800, 0.4}};
  int i = 0;
  const auto condition = [&](const Vessel& v) {
    BenchmarkCondition c;
    c.seed = seed_of(substances[i++ % 8]);
    c.seed.tube_diameter = c.seed.diameter / v.tube;
    c.seed.void_fraction = v.void_fraction, c.seed.sphericity = v.sphericity;
    c.end_time = 4 * response_time(c.seed);
    return c;
  };
  for (const Vessel& v : vessels) f.conditions.push_back(condition(v));
  for (const Vessel& v : possible) f.possible.push_back(condition(v));
  return finished(f);
}

/// Bodies of several shapes settling in suspensions of several densities, from Re 30 to 500.
BenchmarkFamily shapes() {
  BenchmarkFamily f{"shapes", {"velocity"}, 20, {}, {}};
  const Substances substances[] = {{4e-3, 1340, 0.002}, {3e-3, 2500, 0.01},  {4e-3, 1200, 0.001},
                                   {5e-3, 1340, 0.01},  {3e-3, 1340, 0.001}, {4e-3, 2500, 0.02},
                                   {5e-3, 1200, 0.004}, {4e-3, 1800, 0.004}};
  const double sphericity[] = {0.75, 1, 0.85, 0.9, 0.8, 0.7, 0.78, 0.88};
  const double void_fraction[] = {1, 0.9, 0.95, 0.8, 1, 0.9, 0.95, 0.85};
  for (int i = 0; i < 8; ++i) {
    BenchmarkCondition c;
    c.seed = seed_of(substances[i]);
    c.seed.sphericity = sphericity[i], c.seed.void_fraction = void_fraction[i];
    c.end_time = 4 * response_time(c.seed);
    f.conditions.push_back(c);
  }
  return finished(f);
}

/// Carried along by a parabolic profile, as heavy as the liquid.
BenchmarkFamily channel() {
  BenchmarkFamily f{"channel", {"velocity z"}, 30, {}, {}};
  const double share[] = {0.35, 0.6, 0.5, 0.45, 0.65, 0.55, 0.4, 0.6};  // radius over half the width
  int i = 0;
  for (const Substances& s : {Substances{4e-3, 1000, 0.1},
                              {3e-3, 1000, 0.1},
                              {4e-3, 1050, 0.2},
                              {5e-3, 1000, 0.3},
                              {4e-3, 950, 0.3},
                              {3e-3, 1020, 0.1},
                              {4e-3, 1000, 0.2},
                              {5e-3, 1030, 0.4}}) {
    BenchmarkCondition c;
    c.seed = seed_of(s);
    c.seed.gravity = {0, -9.81, 0};  // across the flow and along the walls
    const double speed = 0.02, half = 0.5 * s.diameter / share[i++];
    c.seed.flow.uniform = {0, 0, speed};
    c.seed.flow.curvature = -speed / (half * half);
    c.end_time = 4 * response_time(seed_of({s.diameter, 1000, s.viscosity}));
    f.conditions.push_back(c);
  }
  return finished(f);
}

/// Thrown through air.
BenchmarkFamily air() {
  BenchmarkFamily f{"air", {"position x", "velocity z"}, 20, {}, {}};
  const Vec3 throws[] = {{5, 0, 3}, {8, 0, 0}, {3, 0, 6}, {10, 0, 2},
                         {6, 0, 5}, {2, 0, 0}, {7, 0, 4}, {9, 0, 1}};
  const double diameter[] = {4e-3, 3e-3, 5e-3, 4e-3, 2e-3, 3e-3, 3e-3, 5e-3};
  for (int i = 0; i < 8; ++i) {
    BenchmarkCondition c;
    c.seed = seed_of({diameter[i], i % 2 == 0 ? 1340.0 : 800.0, 1.8e-5, 1.2});
    c.seed.velocity = throws[i];
    c.end_time = 0.8;
    f.conditions.push_back(c);
  }
  return finished(f);
}

}  // namespace

const std::vector<BenchmarkFamily>& benchmark_families() {
  static const std::vector<BenchmarkFamily> families = {
      release(),
      wide_release(),
      oscillating(),
      shear(),
      slow_shear(),
      spinning(),
      walls(),
      vessels("vessels",
              {{0.05, 0.9, 1},
               {0.3, 0.95, 1},
               {0.1, 1, 0.9},
               {0.2, 0.75, 1},
               {0.4, 0.9, 0.95},
               {0.05, 0.65, 1},
               {0.15, 0.8, 0.9},
               {0.25, 0.85, 1}},
              {}),
      shapes(),
      channel(),
      air(),
      vessels("one vessel", {{0.15, 0.85, 1}, {0.15, 0.85, 1}, {0.15, 0.85, 1}, {0.15, 0.85, 1}},
              {{0.02, 0.85, 1}, {0.15, 0.95, 1}, {0.4, 0.85, 1}})};
  return families;
}

const BenchmarkFamily& benchmark_family(const std::string& name) {
  std::vector<std::string> names;
  for (const BenchmarkFamily& family : benchmark_families()) {
    if (family.name == name) return family;
    names.push_back(family.name);
  }
  throw InputError("There is no family of benchmark experiments '" + name + "'. " +
                   suggestion(name, names, "family"));
}

}  // namespace seedflow
