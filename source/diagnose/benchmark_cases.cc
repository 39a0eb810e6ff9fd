#include <iterator>
#include <map>
#include <sstream>

#include "seedflow/diagnose/benchmark.h"

namespace seedflow {

namespace {

std::uint64_t hash(const std::string& text) {
  std::uint64_t h = 14695981039346656037ull;  // FNV-1a
  for (const unsigned char c : text) h = (h ^ c) * 1099511628211ull;
  return h;
}

struct Placing {
  const char* effect;
  const char* family;
  std::vector<std::string> known;
};

/// Every hidden effect in an experiment in which it can be seen.
std::vector<Placing> placings() {
  return {{"Added mass", "oscillating", {"Drag", "Pressure gradient"}},
          {"Pressure gradient", "oscillating", {"Drag", "Added mass"}},
          {"History force", "release", {"Drag", "Pressure gradient", "Added mass"}},
          {"Saffman lift", "slow shear", {"Drag", "Pressure gradient", "Rotational drag"}},
          {"Magnus lift", "spinning", {"Drag", "Pressure gradient", "Rotational drag"}},
          {"Rotational drag", "spinning", {"Drag", "Pressure gradient", "Added mass"}},
          {"Plane wall drag", "walls", {"Drag", "Pressure gradient"}},
          {"Wall lift", "walls", {"Drag", "Pressure gradient", "Plane wall drag"}},
          {"Tube wall drag", "vessels", {"Drag", "Pressure gradient"}},
          {"Hindered settling", "vessels", {"Drag", "Pressure gradient"}},
          {"Nonspherical drag", "shapes", {"Drag", "Pressure gradient"}},
          {"Faxen force", "channel", {"Drag", "Pressure gradient"}},
          {"Drag", "air", {"Pressure gradient"}}};
}

BenchmarkTruth hidden(const Placing& placing, double amplitude) {
  BenchmarkTruth truth;
  truth.family = placing.family, truth.known = placing.known;
  truth.hidden = {placing.effect}, truth.amplitudes = {amplitude};
  return truth;
}

BenchmarkTruth pair(const char* family, const std::vector<std::string>& known, const char* a, const char* b,
                    double amplitude_a, double amplitude_b) {
  BenchmarkTruth truth;
  truth.family = family, truth.known = known;
  truth.hidden = {a, b}, truth.amplitudes = {amplitude_a, amplitude_b};
  return truth;
}

std::vector<BenchmarkTruth> outsiders() {
  std::vector<BenchmarkTruth> list;
  const auto add = [&](const char* family, const TruthSeed::Unknown& unknown, const char* group,
                       double exponent) {
    BenchmarkTruth truth;
    truth.family = family, truth.known = {"Drag", "Pressure gradient"};
    truth.unknown = unknown, truth.outside = true, truth.group = group, truth.exponent = exponent;
    list.push_back(truth);
  };
  TruthSeed::Unknown sideways;
  sideways.uniform = {0.4, 0, 0};
  add("oscillating", sideways, "", 0);
  TruthSeed::Unknown drag;
  drag.drag_amplitude = 0.4, drag.drag_reference = 5, drag.drag_exponent = 0.8;
  add("wide release", drag, "Reynolds number", 0.8);
  TruthSeed::Unknown lift;
  lift.shear_amplitude = 0.03, lift.shear_exponent = 1.5;
  add("shear", lift, "shear Reynolds number", 1.5);
  TruthSeed::Unknown trap;
  trap.trap = 400;
  add("oscillating", trap, "", 0);
  return list;
}

}  // namespace

std::string BenchmarkCase::label() const {
  std::ostringstream text;
  text << kind << " @" << 100 * noise.level << "% " << truth.family << " with";
  for (const std::string& name : truth.known) text << " " << name << ",";
  for (std::size_t i = 0; i < truth.hidden.size(); ++i)
    text << " hidden " << truth.hidden[i] << " x" << truth.amplitudes[i];
  const TruthSeed::Unknown& u = truth.unknown;
  if (truth.outside)
    text << " outside: uniform " << u.uniform.x << " drag " << u.drag_amplitude << " shear "
         << u.shear_amplitude << " trap " << u.trap;
  return text.str();
}

std::vector<BenchmarkCase> benchmark_cases(long draws) {
  constexpr double amplitudes[] = {0.63, 0.97, 1.36};
  constexpr double levels[] = {0.01, 0.02, 0.05, 0.1};
  std::vector<BenchmarkCase> cases;
  std::map<std::string, long> used;
  const auto add = [&](const char* kind, const BenchmarkTruth& truth, const BenchmarkNoise& noise,
                       long count) {
    // The random numbers of a draw do not depend on how many there are, and none are used twice.
    BenchmarkCase one{kind, truth, noise, 0};
    for (long i = 0; i < count; ++i) {
      const std::string label = one.label();
      one.draw = hash(label + " " + std::to_string(used[label]++));
      cases.push_back(one);
    }
  };
  const auto level = [](double value) {
    BenchmarkNoise noise;
    noise.level = value;
    return noise;
  };

  for (const Placing& placing : placings())
    for (const double amplitude : amplitudes)
      for (const double value : levels) add("hidden", hidden(placing, amplitude), level(value), draws);

  // Nothing hidden: every family, noise of every level and kind; 1000 in all at 100 draws.
  std::vector<BenchmarkTruth> nulls;
  for (const Placing& placing : placings()) {
    BenchmarkTruth truth = hidden(placing, 0);
    truth.hidden.clear(), truth.amplitudes.clear();
    nulls.push_back(truth);
    if (std::string(placing.effect) == "Drag") nulls.back().known.push_back("Drag");
  }
  const long each = (10 * draws + static_cast<long>(nulls.size()) - 1) / static_cast<long>(nulls.size());
  for (const BenchmarkTruth& truth : nulls) {
    for (const double value : levels) add("null", truth, level(value), each / 4 + 1);
    BenchmarkNoise spoiled = level(0.02);
    spoiled.correlation = 0.7;
    add("null correlated", truth, spoiled, each / 4 + 1);
    spoiled = level(0.02), spoiled.outliers = 0.03;
    add("null outliers", truth, spoiled, each / 4 + 1);
    spoiled = level(0.02), spoiled.stated = 0.5;
    add("null stated x0.5", truth, spoiled, each / 4 + 1);
    spoiled = level(0.02), spoiled.stated = 2;
    add("null stated x2", truth, spoiled, each / 4 + 1);
  }

  for (const BenchmarkTruth& truth : outsiders())
    for (const double value : {0.02, 0.05}) add("outside", truth, level(value), draws);

  const std::vector<std::string> standard = {"Drag", "Pressure gradient"};
  for (int which = 0; which < 2; ++which)
    for (const double amplitude : {0.8, 1.2}) {
      BenchmarkTruth vessel =
          hidden({which == 0 ? "Tube wall drag" : "Hindered settling", "one vessel", standard}, amplitude);
      vessel.rivals = {"Tube wall drag", "Hindered settling"};
      add("confounded", vessel, level(0.02), draws);
    }

  const BenchmarkTruth twos[] = {pair("oscillating", {"Drag"}, "Pressure gradient", "Added mass", 0.9, 1.1),
                                 pair("spinning", standard, "Rotational drag", "Magnus lift", 1.1, 0.9),
                                 pair("vessels", standard, "Tube wall drag", "Hindered settling", 0.85, 1.15),
                                 pair("walls", standard, "Plane wall drag", "Wall lift", 1.2, 0.8)};
  for (const BenchmarkTruth& truth : twos) add("two", truth, level(0.02), draws);
  return cases;
}

}  // namespace seedflow
