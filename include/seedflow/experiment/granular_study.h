#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "seedflow/experiment/experiment.h"
#include "seedflow/output/plot.h"
#include "seedflow/output/report.h"
#include "seedflow/output/series.h"
#include "seedflow/output/summary.h"

namespace seedflow {

class Parameters;

/// Something else that a study varies: an entry of the experiment.
struct StudyAxis {
  std::string name;            ///< of the list in section "Study": "Inclinations"
  std::string path;            ///< "Screen/Inclination"
  std::string unit;            ///< SI unit of the entry
  std::vector<double> values;  ///< [unit]; empty: not varied
  std::string printed_unit;    ///< for names and legends: "deg"
  double printed_factor = 1;   ///< SI value -> printed value
};

/// Section "Study": every combination of its lists is one run. A single run does not use it.
struct GranularStudyParameters {
  std::vector<double> models{36, 50, 70, 109, 164};  ///< numbers of sub-spheres
  std::vector<std::string> motions{"rigid"};         ///< rigid | bonded
  std::vector<std::string> readings{"radius"};       ///< of Table 2's sizes
  std::vector<std::string> calipers{"as packed"};    ///< as packed | equal
  int repeats = 3;
  StudyAxis axis;

  void declare(Parameters& parameters, const StudyAxis& axis);
};

struct StudyCase {
  int n_spheres = 70;
  std::string motion, reading, caliper;
  double along = 0;  ///< value of the axis [SI]
  int repeat = 1;
  std::string group;         ///< what models and repeats of one curve share, in words
  std::string folder_name;   ///< of its results
  std::string filling_name;  ///< what shares one filling
};

/// Results of a study: observables of all runs, averaged over repeats.
class StudyTable {
 public:
  struct Row {
    StudyCase of;  ///< the first repeat
    int repeats = 0;
    std::map<std::string, double> mean, deviation;  ///< deviation NaN if there is one repeat only
  };
  std::vector<Row> rows;

  /// Mean and deviation of an observable against the paper's surface roughness BS, one curve per group.
  LinePlot against_roughness(const std::string& observable, const std::string& title, const Axis& y) const;
  /// Against the axis of the study, one curve per model and motion.
  LinePlot against_axis(const std::string& observable, const std::string& title, const StudyAxis& axis,
                        const Axis& y) const;
  /// All rows and observables.
  Table all(const std::string& title) const;
  /// "BS 0.1 (N = 70, rigid, radius): 27.9 +- 0.6, 0.9 below the measured 28.8 +- 1.58 ..." for every row's
  /// group in which the models' trend is judged.
  std::string verdict(const std::string& observable, double measured, double deviation) const;

  std::vector<std::string> observables;
};

/// One run of a study: skipped if a finished one with the same parameters is there, continued from its
/// checkpoint if it was begun. Collective over MPI_COMM_WORLD.
void run_unless_finished(RunOptions options, int (*run)(const RunOptions&),
                         std::string (*text_of)(const RunOptions&));
/// An entry of one run; takes the place of what the user set for the study, as an entry may be set once.
void set_entry(RunOptions& options, const std::string& path, const std::string& value);

/// Carries out all runs of a study, one after the other, each in <output>/runs/<name>. A run whose
/// summary.json is there, made with the same parameters, is not repeated; a run with a checkpoint is
/// continued. A run that fails (a heap that rolls away, a lost seed) does not end the study: the others are
/// made, and finish() reports it.
class GranularStudy {
 public:
  using Run = int (*)(const RunOptions&);
  using TextOf = std::string (*)(const RunOptions&);

  /// \param experiment name of the single experiment; `text_of` gives its used.prm.
  GranularStudy(const GranularStudyParameters& study, const RunOptions& options, std::string experiment,
                Run run, TextOf text_of);

  /// False after a dry run. Errors: RunError if every run failed.
  bool carry_out();
  StudyTable table(const std::vector<std::string>& observables) const;
  /// All; after carry_out() those that did not fail.
  const std::vector<StudyCase>& cases() const { return all_cases; }
  Series series_of(const StudyCase& one) const;
  /// Writes study.csv, summary.json and report.html. Errors: RunError, after that, if runs have failed.
  void finish(Report& report, const StudyTable& table) const;

 private:
  RunOptions options_of(const StudyCase& one) const;

  GranularStudyParameters study;
  const RunOptions& options;
  std::string experiment;
  Run run;
  TextOf text_of;
  std::vector<StudyCase> all_cases;
  std::vector<std::string> failures;  ///< "name: why"
};

}  // namespace seedflow
