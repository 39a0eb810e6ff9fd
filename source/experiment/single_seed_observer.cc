#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <sstream>

#include "seedflow/base/nearest_name.h"
#include "seedflow/experiment/single_seed.h"

namespace seedflow {

namespace {

using Read = double (*)(const SingleSeedParameters&, const SingleSeedSample&);

struct SeriesQuantity {
  Observable about;
  Read read;
};

Vec3 down(const SingleSeedParameters& p) {
  const double g = norm(p.gravity);
  return g > 0 ? p.gravity / g : Vec3{0, 0, -1};
}

template <int d>
double velocity(const SingleSeedParameters&, const SingleSeedSample& s) {
  return s.state.velocity[d];
}
template <int d>
double position(const SingleSeedParameters&, const SingleSeedSample& s) {
  return s.state.position[d];
}
template <int d>
double spin(const SingleSeedParameters&, const SingleSeedSample& s) {
  return s.state.angular_velocity[d];
}

double wall_gap(const SingleSeedParameters& p, const SingleSeedSample& s) {
  return std::min(s.flow.wall_distance / p.seed.diameter - 0.5, 1e3);
}

/// Of the seed against what gravity would give it: 1 at the start of a fall, 0 at the terminal speed.
double relative_acceleration(const SingleSeedParameters& p, const SingleSeedSample& s) {
  const double g = std::max(norm(p.gravity), 1e-12) * std::abs(1 - p.density / p.seed.density);
  return norm(s.state.acceleration) / std::max(g, 1e-12);
}

const std::vector<SeriesQuantity>& over_time() {
  using P = SingleSeedParameters;
  using S = SingleSeedSample;
  static const std::vector<SeriesQuantity> all = {
      {{"velocity", "m/s", "time", "s", "speed along gravity"},
       [](const P& p, const S& s) { return dot(s.state.velocity, down(p)); }},
      {{"velocity x", "m/s", "time", "s", "component of the velocity"}, velocity<0>},
      {{"velocity y", "m/s", "time", "s", "component of the velocity"}, velocity<1>},
      {{"velocity z", "m/s", "time", "s", "component of the velocity"}, velocity<2>},
      {{"position x", "m", "time", "s", "component of the centre's position"}, position<0>},
      {{"position y", "m", "time", "s", "component of the centre's position"}, position<1>},
      {{"position z", "m", "time", "s", "component of the centre's position"}, position<2>},
      {{"fall", "m", "time", "s", "distance fallen along gravity since the release"},
       [](const P& p, const S& s) { return dot(s.state.position - p.position, down(p)); }},
      {{"spin x", "rad/s", "time", "s", "component of the angular velocity"}, spin<0>},
      {{"spin y", "rad/s", "time", "s", "component of the angular velocity"}, spin<1>},
      {{"spin z", "rad/s", "time", "s", "component of the angular velocity"}, spin<2>},
      {{"Reynolds number", "1", "time", "s", "rho d |u - v|/mu"},
       [](const P&, const S& s) { return reynolds(s.flow); }},
      {{"wall gap", "1", "time", "s", "from the surface to the nearest wall, in diameters"}, wall_gap},
      {{"relative acceleration", "1", "time", "s", "|dv/dt| over |g (1 - rho/rho_s)|"},
       relative_acceleration}};
  return all;
}

Observable terminal() {
  return {"terminal velocity", "m/s", "", "", "speed along gravity at Run/End time"};
}

Observable drag_coefficient() {
  return {"drag coefficient", "1", "Reynolds number", "1",
          "F/(pi/8 rho d^2 w^2) of the seed held in a uniform stream"};
}

std::vector<double> observe(const SingleSeedParameters& p, const std::vector<WantedValue>& wanted) {
  // One run gives all values over time; its sampling times are those wanted, each once.
  std::map<double, std::size_t> row;
  for (const WantedValue& w : wanted) {
    if (w.quantity == "drag coefficient") continue;
    row[w.quantity == "terminal velocity" ? p.end_time : w.coordinate] = 0;
  }
  std::vector<double> times;
  for (auto& [time, index] : row) index = times.size(), times.push_back(time);
  const std::vector<SingleSeedSample> samples =
      times.empty() ? std::vector<SingleSeedSample>() : run_single_seed(p, times);
  std::vector<double> values;
  values.reserve(wanted.size());
  for (const WantedValue& w : wanted) {
    if (w.quantity == "drag coefficient") {
      values.push_back(single_seed_drag_coefficient(p, w.coordinate));
      continue;
    }
    if (w.quantity == "terminal velocity") {
      values.push_back(dot(samples[row[p.end_time]].state.velocity, down(p)));
      continue;
    }
    const auto found = std::find_if(over_time().begin(), over_time().end(),
                                    [&](const SeriesQuantity& q) { return q.about.name == w.quantity; });
    if (found == over_time().end())
      throw InputError("The experiment single seed produces no quantity \"" + w.quantity + "\".");
    values.push_back(found->read(p, samples[row[w.coordinate]]));
  }
  return values;
}

PreparedRun prepare(const std::string& prm, const std::vector<std::string>& overrides) {
  const auto base = std::make_shared<SingleSeedParameters>();
  Parameters parameters;
  base->declare(parameters);
  parameters.read(prm, overrides);
  base->check(parameters);
  PreparedRun run;
  run.value = [base](const std::string& path) { return base->value(path); };
  run.unit = [](const std::string& path) {
    SingleSeedParameters p;
    Parameters all;
    p.declare(all);
    // Components of vectors have names of their own here, "Seeds/Spin x".
    const bool component = path.size() > 2 && path[path.size() - 2] == ' ' && p.number(path);
    return all.unit(component ? path.substr(0, path.size() - 2) : path);
  };
  run.range = [base](const std::string& quantity) {
    if (quantity == "drag coefficient")
      return CoordinateRange{1e-12, std::numeric_limits<double>::infinity(), false,
                             "A Reynolds number is positive."};
    return CoordinateRange{std::min(0.0, base->release_time), base->end_time, false,
                           "The run ends at Run/End time; raise it in the model, or take the point out."};
  };
  run.simulate = [base](const PreparedRun::Changes& changes, const std::vector<WantedValue>& wanted,
                        MPI_Comm) {
    SingleSeedParameters changed = *base;
    for (const auto& [path, value] : changes) changed.set(path, value);
    changed.effects.prepare();
    return observe(changed, wanted);
  };
  run.idle_effects = [base] {
    std::vector<std::string> idle;
    run_single_seed(*base, {base->end_time}, &idle);
    return idle;
  };
  run.share_in_range = [base](const std::string& effect) {
    SingleSeedParameters with = *base;
    with.set("Effects/" + effect + "/Strength", 1);
    EffectActivity activity;
    run_single_seed(with, {with.end_time}, nullptr,
                    [&](const EffectSet& all) { activity = all[effect].activity(); });
    return activity.evaluations > 0
               ? static_cast<double>(activity.in_range) / static_cast<double>(activity.evaluations)
               : 1.0;
  };
  run.parameters_text = [prm, overrides](const std::vector<std::string>& further) {
    SingleSeedParameters p;
    Parameters all;
    p.declare(all);
    std::vector<std::string> both = overrides;
    both.insert(both.end(), further.begin(), further.end());
    all.read(prm, both);
    std::ostringstream text;
    all.write(text);
    return text.str();
  };
  run.time_step = "Run/Time step";
  return run;
}

}  // namespace

Observer single_seed_observer() {
  Observer observer;
  for (const SeriesQuantity& quantity : over_time()) observer.observables.push_back(quantity.about);
  observer.observables.push_back(terminal());
  observer.observables.push_back(drag_coefficient());
  // Laboratory practice: callipers, pycnometer, a thermometer within 0.5 K; correlations of the drag of a
  // sphere scatter by 4 to 6 % (Brown & Lawler 2003, doi:10.1061/(ASCE)0733-9372(2003)129:3(222)).
  observer.uncertainties = {{"seed diameter", "Seeds/Diameter", 0.01, true, false},
                            {"seed density", "Seeds/Density", 0.005, true, false},
                            {"fluid viscosity", "Air/Dynamic viscosity", 0.02, true, false},
                            {"fluid density", "Air/Density", 0.001, true, false},
                            {"drag level", "Effects/Drag/Strength", 0.04, true, false},
                            {"drag level of a condition", "Effects/Drag/Strength", 0.02, true, true}};
  observer.prepare = prepare;
  observer.regimes = {"Reynolds number", "wall gap", "relative acceleration"};
  return observer;
}

}  // namespace seedflow
