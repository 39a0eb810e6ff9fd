#pragma once

#include <functional>
#include <string>
#include <vector>

#include "seedflow/base/parameters.h"
#include "seedflow/experiment/experiment.h"

namespace seedflow {

/// How an experiment that takes minutes serves as a model of measurements: it is run as a user runs it, into
/// a folder of its own, and the wanted values are read from its files.
struct FileObserver {
  /// The experiment; collective over RunOptions::comm.
  int (*run)(const RunOptions&) = nullptr;
  /// Reads file and overrides into parameters that live no longer than the call, then calls `look`.
  std::function<void(const RunOptions&, const std::function<void(const Parameters&)>& look)> read;
  std::vector<Observable> observables;
  std::vector<UsualUncertainty> uncertainties;
  std::function<std::vector<UsualUncertainty>(const Parameters&)> further_uncertainties;  ///< of this model
  std::function<CoordinateRange(const Parameters&, const std::string& quantity)> range;   ///< may be null
  /// One value [SI] from the files of a finished run.
  std::function<double(const std::string& folder, const WantedValue&, const RunOptions&)> value;
  std::string random_entry = "";  ///< see Observer::random_entry
  std::string time_step = "";  ///< entry to be halved for the numerical error; "" where that costs too much
};

Observer make_observer(const FileObserver& files);

}  // namespace seedflow
