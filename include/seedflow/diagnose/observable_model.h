#pragma once

#include <Eigen/Core>
#include <map>
#include <optional>
#include <string>
#include <unordered_set>
#include <vector>

#include "seedflow/diagnose/diagnosis.h"
#include "seedflow/diagnose/run_store.h"

namespace seedflow {

struct EffectRecord;

/// One measured value in SI units, tied to a condition of the model.
struct DataPoint {
  int condition = 0, series = 0;  ///< a series is one quantity under one condition
  std::string quantity;
  double coordinate = 0;  ///< NaN if the quantity has none
  double value = 0, sigma = 0;
  double correlated_sigma = 0, correlation_length = 0;
  double unit_scale = 1;  ///< SI value over value in the unit of the measurement
};

/// What a simulated value depends on, besides the base model.
struct Setting {
  std::map<int, double> amplitude;  ///< of candidates, by index; others absent
  std::map<int, double> error;      ///< of input errors, by index, in standard deviations; others 0
  double step_factor = 1;           ///< on the time step
  std::map<std::string, double> entries = {};  ///< further entries by path, SI
};

/// The simulation as a function: settings -> values at all measured points. Runs are remembered by the store.
class ObservableModel {
 public:
  /// Checks the problem. Throws InputError naming file, line or entry.
  ObservableModel(const Problem& problem, RunStore& store);

  const std::vector<DataPoint>& points() const { return data; }
  const std::vector<Condition>& conditions() const { return problem.conditions; }
  const std::vector<Candidate>& candidates() const { return all_candidates; }
  const std::vector<Nuisance>& nuisances() const { return all_nuisances; }
  const std::vector<std::string>& regimes() const { return observer.regimes; }
  /// "time", ...
  const std::string& coordinate_name(const std::string& quantity) const;
  int n_series() const { return series_count; }

  /// Input errors: one per nuisance and group of conditions that share it.
  struct UncertainInput {
    int nuisance = 0;
    std::vector<bool> applies;  ///< per condition
  };
  const std::vector<UncertainInput>& uncertain_inputs() const { return errors; }

  /// Values at all points, NaN in conditions whose run failed or that the budget no longer allows. Where
  /// repetitions scatter, means over the repeats.
  Eigen::VectorXd predict(const Setting& setting);
  /// Makes the runs of several settings at once, shared over the ranks; predict() then finds them done.
  void prepare_runs(const std::vector<Setting>& settings);
  /// Where repetitions scatter: adds the standard error of their mean to the uncertainty of every point, and
  /// returns the smallest and largest by quantity. Estimated under every condition from the repetitions of
  /// all these settings, drawn towards the mean of all conditions with the weight of a few repetitions.
  std::map<std::string, std::pair<double, double>> add_scatter(const std::vector<Setting>& settings);
  int repeats() const { return n_repeats; }
  /// From now on so many runs more than were asked for so far are allowed.
  void allow(long runs) { allowed = runs; }
  bool out_of_budget() const { return refused; }
  /// The same for another condition, at the same quantities and coordinates as `like`.
  Eigen::VectorXd predict_condition(const Condition& condition, int like, const Setting& setting);
  /// A regime beside every point (NaN where it has none), in the base model.
  Eigen::VectorXd regime(const std::string& name);
  /// Effects that are on in the base model and do nothing, by condition.
  std::vector<std::string> idle_effects();
  /// Share of the runs in which an effect that is off would be inside its range, over the conditions; 1 if
  /// unknown.
  double share_in_range(const std::string& effect);
  bool can_halve_step() const { return !step_path.empty(); }
  std::size_t points_in(int condition) const { return wanted[condition].size(); }

  /// Entries of the .prm that make up a setting under one condition.
  std::vector<std::pair<std::string, double>> changes(const Setting& setting, int condition) const;
  /// The same for the base model as it stands; errors of inputs as under the first condition.
  std::vector<std::pair<std::string, double>> changes(const Setting& setting) const;
  /// Candidates and nuisances that the base model already has.
  double base_value(const std::string& path, int condition) const;
  bool has_entry(const std::string& path) const;
  /// Entries of a setting that are no numbers, "PATH=VALUE".
  std::vector<std::string> choices(const Setting& setting) const;

  /// Every run that was asked for and not refused, once, with its command and what became of it.
  const std::vector<RunRecord>& records() const { return run_list; }
  long runs() const { return n_runs; }

 private:
  void read_points();
  void choose_candidates();
  /// Whether the base model has the entry of an effect and it is at its value without the effect.
  bool is_off(const EffectRecord& effect) const;
  void choose_nuisances();
  const PreparedRun& prepare(const Condition& condition) const;
  std::vector<std::pair<std::string, double>> changes(const Setting& setting, int condition,
                                                      const PreparedRun& sizes) const;
  /// What is asked of the model of one condition.
  struct Asked {
    const Condition& condition;
    const PreparedRun& model;
    const std::vector<WantedValue>& values;
    std::string key_head;  ///< of the run's key in the store
  };
  std::string key_head(const Condition& condition, const std::vector<WantedValue>& values) const;
  const RunOutcome& run(const Asked& asked, const PreparedRun::Changes& changes);
  /// The condition with the choices of a setting's candidates, and the model of it.
  struct Chosen {
    Condition condition;
    const PreparedRun* model;  ///< null if the choices are not allowed
    std::string key_head;
    std::string error = "";  ///< why there is no model
  };
  Chosen chosen(const Setting& setting, int condition);
  /// The changes of a setting under one condition, once per repeat.
  std::vector<PreparedRun::Changes> repeated(const Setting& setting, int condition) const;
  bool may_run(const std::string& key);
  void note(const Condition& condition, const PreparedRun::Changes& changes, const std::string& error,
            double seconds);

  const Problem& problem;
  RunStore& store;
  Observer observer;
  std::string identity;  ///< of the base model
  std::vector<const PreparedRun*> ready;
  std::vector<std::string> key_heads;  ///< per condition
  std::vector<DataPoint> data;
  std::vector<std::vector<WantedValue>> wanted;       ///< per condition
  std::vector<std::vector<std::size_t>> point_index;  ///< of the wanted values
  std::vector<Candidate> all_candidates;
  std::vector<Nuisance> all_nuisances;
  std::vector<UncertainInput> errors;
  std::string step_path;
  std::vector<RunRecord> run_list;
  std::unordered_set<std::string> listed_commands;
  int series_count = 0;
  int n_repeats = 1;
  long n_runs = 0, allowed = 0;
  bool refused = false;
  RunOutcome refusal;
  std::unordered_set<std::string> asked_for;  ///< keys, against the budget
};

}  // namespace seedflow
