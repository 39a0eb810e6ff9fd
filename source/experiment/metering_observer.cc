// The metering device as a model of measurements on a test bench.

#include <cmath>
#include <memory>
#include <sstream>

#include "seedflow/base/error.h"
#include "seedflow/base/units.h"
#include "seedflow/experiment/metering_map.h"

namespace seedflow {

namespace {

void read(const std::string& prm, const std::vector<std::string>& overrides,
          const std::function<void(const MeteringInput&, const Parameters&)>& look) {
  RunOptions options;
  options.prm = prm, options.overrides = overrides;
  MeteringInput input(options);
  Parameters parameters;
  input.declare(parameters);
  parameters.read(prm, overrides);
  input.experiment.check(parameters);
  look(input, parameters);
}

/// The vacuum.
double holes_facing(const Metering& m) {
  double facing = 0;
  for (int k = 0; k < m.device.n_holes(); ++k) facing += m.device.exposure(m.device.hole_angle(k, 0));
  return facing;
}

double value_of(const Metering& metering, const WantedValue& wanted) {
  const SuctionBench bench = suction_bench(metering, wanted.coordinate);
  if (wanted.quantity == "air flow") return bench.flow;
  if (wanted.quantity == "chamber vacuum") return bench.vacuum;
  if (wanted.quantity == "holding force") return bench.holding;
  throw InputError("The experiment metering produces no quantity \"" + wanted.quantity + "\".");
}

PreparedRun prepare(const std::string& prm, const std::vector<std::string>& overrides) {
  read(prm, overrides,
       [](const MeteringInput&, const Parameters&) {});  // mistakes are found before anything runs
  PreparedRun run;
  run.value = [prm, overrides](const std::string& path) {
    double value = 0;
    read(prm, overrides,
         [&](const MeteringInput&, const Parameters& p) { value = to_si(p.value(path), p.unit(path)); });
    return value;
  };
  run.text = [prm, overrides](const std::string& path) {
    std::string value;
    read(prm, overrides, [&](const MeteringInput&, const Parameters& p) { value = p.value(path); });
    return value;
  };
  run.unit = [prm, overrides](const std::string& path) {
    std::string unit;
    read(prm, overrides, [&](const MeteringInput&, const Parameters& p) { unit = p.unit(path); });
    return unit;
  };
  run.range = [prm, overrides](const std::string&) {
    CoordinateRange range{0, 0, false, "Only these holes face the vacuum."};
    read(prm, overrides,
         [&](const MeteringInput& input, const Parameters&) { range.high = holes_facing(input.experiment); });
    return range;
  };
  run.simulate = [prm, overrides](const PreparedRun::Changes& changes, const std::vector<WantedValue>& wanted,
                                  MPI_Comm) {
    std::vector<std::string> all = overrides;
    for (const auto& [path, value] : changes) all.push_back(path + "=" + exact_text(value));
    std::vector<double> values;
    read(prm, all, [&](const MeteringInput& input, const Parameters&) {
      for (const WantedValue& w : wanted) values.push_back(value_of(input.experiment, w));
    });
    return values;
  };
  run.parameters_text = [prm, overrides](const std::vector<std::string>& further) {
    std::vector<std::string> all = overrides;
    all.insert(all.end(), further.begin(), further.end());
    std::ostringstream text;
    read(prm, all, [&](const MeteringInput&, const Parameters& p) { p.write(text); });
    return text.str();
  };
  return run;
}

}  // namespace

SuctionBench suction_bench(const Metering& m, double covered) {
  const double radius = 0.5 * m.granular.model.diameter;
  CoveredHole hole(m.device.hole_radius(), m.device.chamfer, radius);
  hole.hole_coefficient = m.suction.hole_coefficient;
  hole.gap_coefficient = m.suction.gap_coefficient;
  hole.roughness = m.suction.seat_roughness;
  const double height = std::sqrt(radius * radius - hole.seat_radius * hole.seat_radius) - hole.seat_depth;
  const CoveredHole::Outcome open = hole.evaluate({}, 1);
  const CoveredHole::Outcome closed = hole.evaluate({{{0, 0, height}, radius}}, 1);
  const double facing = holes_facing(m);
  if (!(covered >= 0 && covered <= facing))
    throw InputError("covered holes = " + std::to_string(covered) + ": only " + std::to_string(facing) +
                     " holes face the vacuum.");
  const double area =
      (facing - covered) * open.flow_area + covered * closed.flow_area + leak_area(m.suction, m.device);
  const SuctionBalance balance = suction_balance(m.suction, area);
  return {balance.flow, balance.drop, -closed.cover * closed.area[0].z * balance.drop};
}

Observer metering_observer() {
  Observer observer;
  observer.observables = {
      {"air flow", "m3/s", "covered holes", "1", "through the fan, disc at rest"},
      {"chamber vacuum", "Pa", "covered holes", "1", "below the surroundings, positive"},
      {"holding force", "N", "covered holes", "1", "on a seed seated on a hole, normal to the disc"}};
  // A gauge of 1 %, pin gauges of 0.02 mm, discharge coefficients within 3 %, a barometer and thermometer.
  observer.uncertainties = {{"fan's vacuum", "Suction/Vacuum", 0.01, true, true},
                            {"hole diameter", "Device/Hole diameter", 0.01, true, false},
                            {"discharge coefficient", "Suction/Discharge coefficient", 0.03, true, false},
                            {"seat roughness", "Suction/Seat roughness", 0.5, true, false},
                            {"air density", "Air/Density", 0.01, true, false}};
  observer.prepare = prepare;
  return observer;
}

}  // namespace seedflow
