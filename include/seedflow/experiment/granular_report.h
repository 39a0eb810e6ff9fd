#pragma once

#include <functional>
#include <string>

#include "seedflow/base/interrupt.h"
#include "seedflow/experiment/granular_run.h"
#include "seedflow/experiment/granular_study.h"
#include "seedflow/experiment/seed_picture.h"
#include "seedflow/output/folder.h"
#include "seedflow/output/report.h"

namespace seedflow {

/// What the granular experiments' entry points have in common: prepares the output folder and the run, and
/// brings what was found to the user.
struct GranularJob {
  GranularJob(const Parameters& parameters, const RunOptions& options, const GranularParameters& granular,
              const GranularScene& scene);

  /// --dry-run.
  int say_what_it_will_be() const;
  /// On rank 0 writes summary.json and what `write_files` writes; then asserts the balances.
  int finish(Summary& summary, const std::function<void()>& write_files) const;

  InterruptGuard signals;  ///< a signal during the set-up is seen before the first step
  const RunOptions& options;
  bool writes;
  GranularRun run;

 private:
  static const RunOptions& prepared(const RunOptions& options);
};

/// All entries of an experiment's .prm: the experiment's own, and the study's, which a single run does not
/// use.
template <class Experiment>
struct GranularInput {
  GranularInput(const std::string& experiment_name, const StudyAxis& study_axis)
      : name(experiment_name), axis(study_axis) {}
  /// `options` name the file that lists walls, materials and feeders, whose sections are to be declared.
  GranularInput(const std::string& experiment_name, const StudyAxis& study_axis, const RunOptions& options)
      : GranularInput(experiment_name, study_axis) {
    experiment.granular = GranularParameters(options.prm, options.overrides);
  }
  void declare(Parameters& p) {
    declare_experiment_name(p, name);
    experiment.declare(p);
    study.declare(p, axis);
  }

  std::string name;
  Experiment experiment;
  GranularStudyParameters study;
  StudyAxis axis;
};

/// used.prm of a run with these options. `Input` declares all entries.
template <class Input>
std::string used_text(const RunOptions& options) {
  Input input(options);
  Parameters parameters;
  input.declare(parameters);
  parameters.read(options.prm, options.overrides);
  return as_text(parameters);
}

/// FileObserver::read of an experiment. `Input` declares all entries.
template <class Input>
void look_at_checked(const RunOptions& options, const std::function<void(const Parameters&)>& look) {
  Input input(options);
  Parameters parameters;
  input.declare(parameters);
  parameters.read(options.prm, options.overrides);
  input.experiment.check(parameters);
  look(parameters);
}

/// "2227 seeds of 4 mm (70 sub-spheres each, rigid)".
std::string seeds_in_words(const GranularRun& run, const GranularParameters& granular);
/// Kinetic energy per seed against time, logarithmic.
LinePlot energy_plot(const Series& series, int n_seeds);
/// Tables of all observables and balances, and where the other files are.
void add_numbers(const Summary& summary, Report& report);
/// "3.14".
std::string fixed(double value, int digits);

}  // namespace seedflow
