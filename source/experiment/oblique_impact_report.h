#pragma once

#include <string>
#include <vector>

#include "seedflow/experiment/measurements.h"
#include "seedflow/experiment/oblique_impact.h"

namespace seedflow {

/// One measured value and what is computed for the same angle; SI.
struct MeasuredImpact {
  std::string quantity;
  double angle = 0, value = 0, uncertainty = 0, computed = 0;
};

/// All impacts under one condition.
struct Sweep {
  std::string name;
  std::vector<double> angles;  ///< ascending [rad]
  std::vector<Rebound> rebounds;
  std::vector<MeasuredImpact> measured;
  double sliding_from = 0;   ///< [rad]
  double sliding_error = 0;  ///< largest relative deviation of the tangential impulse beyond
};

/// The value of a quantity of the observer.
double value_of(const Rebound& rebound, const std::string& quantity);

struct Agreement {
  int n = 0;
  double rms = 0;                             ///< of computed - measured, SI
  double rms_scaled = 0, largest_scaled = 0;  ///< of the same over the standard uncertainty
};
Agreement agreement(const Sweep& sweep, const std::string& quantity);

void write_impact_report(const std::vector<Sweep>& sweeps, const ObliqueImpactParameters& first,
                         const RunOptions& options);

}  // namespace seedflow
