#pragma once

#include <mpi.h>

#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace seedflow {

/// A quantity an experiment produces beside measurements.
struct Observable {
  std::string name, unit;                   ///< "velocity", "m/s"
  std::string coordinate, coordinate_unit;  ///< "time", "s"; "" where the quantity has none
  std::string doc;
};

/// One value that is wanted of a run.
struct WantedValue {
  std::string quantity;
  double coordinate = 0;  ///< SI
};

/// Where a run gives a quantity that has a coordinate.
struct CoordinateRange {
  double low = -std::numeric_limits<double>::infinity();  ///< SI, included, as is high
  double high = std::numeric_limits<double>::infinity();
  bool whole = false;  ///< whole numbers only
  std::string remedy;  ///< for a coordinate outside: "Raise Run/End time."
};

/// An input whose usual uncertainty the experiment knows.
struct UsualUncertainty {
  std::string name, path;
  double standard_deviation = 0;
  bool relative = true, each_condition = false;
};

/// A model of one condition that is ready to run again and again with changed numbers.
struct PreparedRun {
  /// The present value of a numeric entry, SI. InputError if there is none of that path.
  std::function<double(const std::string& path)> value;
  /// The present value of any entry as text (an option, true or false). InputError if there is none of that
  /// path; may be empty where the model has no choices that are effects.
  std::function<std::string(const std::string& path)> text = nullptr;
  /// The SI unit of that entry ("1" for none).
  std::function<std::string(const std::string& path)> unit;
  /// Which coordinates of a quantity a run has; known before it runs. Null: all.
  std::function<CoordinateRange(const std::string& quantity)> range;
  /// Those that depend on the model, beside the observer's.
  std::vector<UsualUncertainty> uncertainties;
  using Changes = std::vector<std::pair<std::string, double>>;
  /// Runs with some entries changed, on the processes of a communicator (collective), and returns the wanted
  /// values in order. Independent of earlier calls. Errors: InputError, RunError.
  std::function<std::vector<double>(const Changes&, const std::vector<WantedValue>&, MPI_Comm)> simulate;
  std::vector<double> observe(const Changes& changes, const std::vector<WantedValue>& wanted,
                              MPI_Comm comm = MPI_COMM_SELF) const {
    return simulate(changes, wanted, comm);
  }
  /// Entries that are on and did nothing in the base run ("" entries none); computed by running it.
  std::function<std::vector<std::string>()> idle_effects;
  /// Share of the base run, with the effect switched on, that is inside its range of validity; "" if unknown.
  std::function<double(const std::string& effect)> share_in_range;
  /// The complete .prm with further overrides, to be run as it is.
  std::function<std::string(const std::vector<std::string>& overrides)> parameters_text;
  std::string time_step;  ///< path of the entry whose halving shows the numerical error, or ""
};

/// How an experiment is used as a model of measurements.
struct Observer {
  std::vector<Observable> observables;
  std::vector<UsualUncertainty> uncertainties;
  /// Reads file and overrides.
  std::function<PreparedRun(const std::string& prm, const std::vector<std::string>& overrides)> prepare;
  /// Known beside every value, for the search of the place: "Reynolds number", ... (may be empty).
  std::vector<std::string> regimes;
  /// Entry of the random numbers of an experiment whose repetitions scatter (a filling of grains), or "".
  std::string random_entry;
};

}  // namespace seedflow
