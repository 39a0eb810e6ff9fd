#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <map>
#include <random>
#include <sstream>

#include "seedflow/base/error.h"
#include "seedflow/diagnose/benchmark.h"

namespace seedflow {

namespace {

std::string text_of(double value) {
  std::ostringstream text;
  text.precision(17);
  text << value;
  return text.str();
}

std::string text_of(const Vec3& v) {
  return text_of(v.x) + ", " + text_of(v.y) + ", " + text_of(v.z);
}

/// What the experimenters tell the workflow of a condition.
Condition told(const BenchmarkCondition& c) {
  const TruthSeed& s = c.seed;
  Condition condition{c.name, c.held_out, {}};
  const auto set = [&](const std::string& path, const std::string& value) {
    condition.overrides.push_back(path + "=" + value);
  };
  set("Seeds/Diameter", text_of(s.diameter));
  set("Seeds/Density", text_of(s.density));
  set("Seeds/Sphericity", text_of(s.sphericity));
  set("Seeds/Position", text_of(s.position));
  set("Seeds/Velocity", text_of(s.velocity));
  set("Seeds/Spin", text_of(s.spin));
  set("Seeds motion/Gravity", text_of(s.gravity));
  set("Air/Density", text_of(s.fluid_density));
  set("Air/Dynamic viscosity", text_of(s.viscosity));
  set("Air/Void fraction", text_of(s.void_fraction));
  const auto flow = s.flow.expressions();
  for (int d = 0; d < 3; ++d) set(std::string("Air/Prescribed/Velocity ") + "xyz"[d], flow[d]);
  set("Vessel/Tube diameter", text_of(s.tube_diameter));
  std::string faces;
  for (const std::string& face : c.faces) faces += (faces.empty() ? "" : ", ") + face;
  set("Vessel/Walls", faces);
  set("Vessel/Lower corner", text_of(c.lower));
  set("Vessel/Upper corner", text_of(c.upper));
  set("Run/End time", text_of(c.end_time));
  set("Run/Time step", text_of(c.time_step));
  return condition;
}

using Random = std::mt19937_64;

/// Inputs are off their nominal values by what callipers, pycnometers and thermometers leave open; equal
/// nominal values are off by the same. No correlation knows the drag of a seed better than about 4 %.
class Inputs {
 public:
  explicit Inputs(Random& random) : random(random), drag(1 + 0.035 * normal()) {}

  void disturb(TruthSeed& s) {
    s.diameter *= 1 + error("diameter", s.diameter, 0.01);
    s.density *= 1 + error("density", s.density, 0.005);
    s.viscosity *= 1 + error("viscosity", s.viscosity, 0.02);
    s.fluid_density *= 1 + error("fluid density", s.fluid_density, 0.001);
    s.drag_level = drag * (1 + 0.015 * normal());
  }

 private:
  double normal() { return std::normal_distribution<double>()(random); }
  double error(const char* name, double nominal, double deviation) {
    const auto [found, fresh] = errors.try_emplace({name, nominal}, 0);
    if (fresh) found->second = deviation * normal();
    return found->second;
  }

  Random& random;
  double drag;
  std::map<std::pair<std::string, double>, double> errors;
};

double read(const std::string& quantity, const TruthSeed& seed, const TruthState& state) {
  const char axis = quantity.back();
  const int d = axis - 'x';
  if (quantity == "velocity") return dot(state.velocity, seed.gravity) / norm(seed.gravity);
  if (quantity.rfind("velocity ", 0) == 0) return state.velocity[d];
  if (quantity.rfind("position ", 0) == 0) return state.position[d];
  if (quantity.rfind("spin ", 0) == 0) return state.spin[d];
  throw InputError("The benchmark cannot make the quantity '" + quantity + "'.");
}

std::string unit_of(const std::string& quantity) {
  return quantity.rfind("position", 0) == 0 ? "m" : quantity.rfind("spin", 0) == 0 ? "rad/s" : "m/s";
}

TruthSeed with_amplitudes(TruthSeed seed, const BenchmarkTruth& truth, bool hidden) {
  for (const std::string& effect : truth.known) seed.amplitudes[effect] = 1;
  if (!hidden) return seed;
  for (std::size_t i = 0; i < truth.hidden.size(); ++i)
    seed.amplitudes[truth.hidden[i]] = truth.amplitudes[i];
  seed.unknown = truth.unknown;
  return seed;
}

/// Standard normal noise whose neighbours are correlated.
std::vector<double> noise_series(int n, double correlation, Random& random) {
  std::normal_distribution<double> normal;
  std::vector<double> noise(n);
  double last = normal(random);
  for (double& value : noise) {
    value = last;
    last = correlation * last + std::sqrt(1 - correlation * correlation) * normal(random);
  }
  return noise;
}

std::vector<double> values_of(const std::string& quantity, const TruthSeed& seed,
                              const std::vector<TruthState>& states) {
  std::vector<double> values;
  for (const TruthState& state : states) values.push_back(read(quantity, seed, state));
  return values;
}

/// Largest change from the start: what a reader of the curve calls its size.
double size_of(const std::vector<double>& values, double start) {
  double size = 0;
  for (const double value : values) size = std::max(size, std::abs(value - start));
  return size;
}

}  // namespace

void write_benchmark_base(const std::filesystem::path& prm) {
  std::ofstream(prm) << "set Experiment = single seed\n";
}

BenchmarkData benchmark_data(const BenchmarkTruth& truth, const BenchmarkNoise& noise, std::uint64_t draw,
                             const std::filesystem::path& prm, const std::vector<Condition>& extra) {
  const BenchmarkFamily& family = benchmark_family(truth.family);
  BenchmarkData data;
  Problem& problem = data.problem;
  problem.name = "benchmark";
  problem.prm = prm.string();
  for (const char* standard : {"Drag", "Pressure gradient"})
    problem.overrides.push_back(std::string("Effects/") + standard + "/Strength=0");
  for (const std::string& effect : truth.known) {
    const std::string path = "Effects/" + effect + "/Strength=";
    const auto off = std::find(problem.overrides.begin(), problem.overrides.end(), path + "0");
    if (off != problem.overrides.end()) problem.overrides.erase(off);
    problem.overrides.push_back(path + "1");
  }

  std::vector<BenchmarkCondition> conditions = family.conditions;
  for (const Condition& wanted : extra)
    for (const BenchmarkCondition& possible : family.possible)
      if (possible.name == wanted.name) conditions.push_back(possible);
  for (const BenchmarkCondition& possible : family.possible)
    problem.possible_experiments.push_back(told(possible));

  Random random(draw * 0x9e3779b97f4a7c15u + 12345);
  Inputs inputs(random);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  for (const BenchmarkCondition& c : conditions) {
    problem.conditions.push_back(told(c));
    std::vector<double> times;
    for (int i = 1; i <= family.points; ++i) times.push_back(i * c.end_time / family.points);
    TruthSeed seed = c.seed;
    inputs.disturb(seed);
    const std::vector<TruthState> states = truth_states(with_amplitudes(seed, truth, true), times);
    const std::vector<TruthState> without = truth_states(with_amplitudes(seed, truth, false), times);
    // The resolution of the instrument, the same for every quantity of one kind and whatever is hidden.
    for (const std::string& quantity : family.quantities) {
      const double start = quantity.rfind("position", 0) == 0
                               ? read(quantity, seed, {seed.position, seed.velocity, seed.spin})
                               : 0;
      const std::vector<double> clean = values_of(quantity, seed, states),
                                base = values_of(quantity, seed, without);
      const double floor = quantity.rfind("position", 0) == 0 ? 0.1 * seed.diameter : 0;
      const double sigma = noise.level * std::max({size_of(clean, start), size_of(base, start), floor});
      const std::vector<double> error = noise_series(family.points, noise.correlation, random);
      for (int i = 0; i < family.points; ++i) {
        Measurement m;
        m.condition = c.name, m.quantity = quantity, m.unit = unit_of(quantity);
        m.coordinate = times[i], m.coordinate_unit = "s";
        m.value = clean[i] + sigma * error[i];
        if (uniform(random) < noise.outliers)
          m.value += (uniform(random) < 0.5 ? -1 : 1) * (5 + 5 * uniform(random)) * sigma;
        m.standard_uncertainty = noise.stated * sigma;
        problem.measurements.push_back(m);
        data.disagreement.push_back((clean[i] - base[i]) / sigma);
        data.states.push_back(states[i]);
      }
    }
  }
  return data;
}

}  // namespace seedflow
