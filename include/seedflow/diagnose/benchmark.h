#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

#include "seedflow/diagnose/diagnosis.h"
#include "seedflow/experiment/experiment.h"
#include "seedflow/truth/truth_seed.h"

namespace seedflow {

// The hidden-effect benchmark: data made by the independent generator of the layer `truth`, an effect hidden
// in them, given to diagnose(), which sees the base model, the measurements and the conditions and nothing
// else; its verdict is then compared with what was hidden.

/// One condition of an experiment: the seed as the makers of the experiment believe it to be.
struct BenchmarkCondition {
  std::string name;
  bool held_out = false;
  TruthSeed seed;
  double end_time = 1, time_step = 1e-3;
  std::vector<std::string> faces;  ///< walls of the box between `lower` and `upper`
  Vec3 lower{-1, -1, -1}, upper{1, 1, 1};
};

/// An experiment: conditions and what is measured under all of them.
struct BenchmarkFamily {
  std::string name;
  std::vector<std::string> quantities;  ///< of the experiment "single seed", over time
  int points = 20;                      ///< of each quantity, at equal intervals
  std::vector<BenchmarkCondition> conditions;
  std::vector<BenchmarkCondition> possible;  ///< further experiments that could be made
};
const std::vector<BenchmarkFamily>& benchmark_families();
const BenchmarkFamily& benchmark_family(const std::string& name);

/// What is in the data. The label of a case: the workflow never sees it.
struct BenchmarkTruth {
  std::string family;
  std::vector<std::string> known;   ///< effects that model and truth both have
  std::vector<std::string> hidden;  ///< effects that only the truth has
  std::vector<double> amplitudes;   ///< of the hidden effects
  TruthSeed::Unknown unknown;       ///< force outside the catalogue
  bool outside = false;             ///< whether there is one
  double exponent = 0;              ///< of that force, in the group below
  std::string group;                ///< "" : no exponent to compare
  std::vector<std::string> rivals;  ///< of a confounded design
};

/// How the data are spoiled.
struct BenchmarkNoise {
  double level = 0.02;     ///< standard deviation over the largest value of the quantity under the condition
  double correlation = 0;  ///< of neighbouring points (autoregressive); not told
  double outliers = 0;     ///< share of points displaced by 5 to 10 standard deviations
  double stated = 1;       ///< stated over true uncertainty
};

/// The data of one draw: inputs off their nominal values, noise.
struct BenchmarkData {
  Problem problem;
  std::vector<double> disagreement;  ///< per measurement: what the hidden part alone changes, without noise,
                                     ///< in standard deviations
  std::vector<TruthState> states;    ///< per measurement
};
/// `prm` is the file of the base model (see write_benchmark_base). Extra conditions of the family, by name,
/// are measured as well.
BenchmarkData benchmark_data(const BenchmarkTruth& truth, const BenchmarkNoise& noise, std::uint64_t draw,
                             const std::filesystem::path& prm,
                             const std::vector<Condition>& extra_conditions = {});
/// A base file for all families: everything else is in the overrides.
void write_benchmark_base(const std::filesystem::path& prm);

/// A group of cases that make up a figure of the table.
struct BenchmarkCase {
  std::string kind;  ///< "hidden", "null", "outside", "confounded", "two"
  BenchmarkTruth truth;
  BenchmarkNoise noise;
  std::uint64_t draw = 0;
  std::string label() const;  ///< what is hidden, and in what noise
};

/// How a case ended.
struct BenchmarkOutcome {
  bool right = false, wrong = false, none = false, ambiguous = false, flagged = false, input = false;
  bool listed = false;    ///< the truth is among the rivals of AMBIGUOUS
  bool resolved = false;  ///< after the suggested experiment
  double confidence = 0;  ///< posterior of the verdict's explanation
  bool confidence_right = false;
  int intervals = 0, covered = 0;
  int places = 0, place_right = 0;
  int exponents = 0, exponent_right = 0, exponent_covered = 0;
  double gap_before = 0, gap_after = 0;  ///< chi2/n on held-out conditions
  double seconds = 0;
  std::string answer;  ///< verdict and names, for the list of failures
};

/// The workflow under test.
using Diagnose = std::function<Diagnosis(const Problem&)>;

BenchmarkOutcome judge(const BenchmarkCase& one, const Diagnose& diagnose, const std::filesystem::path& prm);

/// All cases of the full benchmark with `draws` draws per hidden effect, amplitude and noise.
std::vector<BenchmarkCase> benchmark_cases(long draws);

/// A share of cases, with its 95 % interval.
struct BenchmarkFigure {
  std::string name;
  long hits = 0, of = 0;
  double value() const { return of > 0 ? static_cast<double>(hits) / of : 0; }
};
/// Clopper & Pearson (1934), doi:10.1093/biomet/26.4.404: exact interval of a binomial share.
Interval clopper_pearson(long hits, long of, double confidence = 0.95);

/// Runs all cases over the ranks of MPI_COMM_WORLD, prints the table on rank 0 and returns it. What is
/// finished is kept in the folder (nothing: nowhere) and not repeated by the same program. `only`: cases
/// whose label has these words.
std::vector<BenchResult> run_diagnosis_benchmark(long draws, const std::string& only,
                                                 const std::filesystem::path& kept, std::ostream& out);

}  // namespace seedflow
