#include "seedflow/diagnose/benchmark.h"

#include <mpi.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <iomanip>
#include <map>
#include <memory>
#include <ostream>
#include <sstream>

#include "seedflow/base/error.h"
#include "seedflow/base/together.h"
#include "seedflow/diagnose/run_store.h"
#include "seedflow/output/progress.h"

namespace seedflow {

namespace {

/// Probability of at least k hits in n trials of probability p.
double upper_tail(long k, long n, double p) {
  double sum = 0;
  for (long i = k; i <= n; ++i)
    sum += std::exp(std::lgamma(n + 1.0) - std::lgamma(i + 1.0) - std::lgamma(n - i + 1.0) + i * std::log(p) +
                    (n - i) * std::log1p(-p));
  return sum;
}

/// Effects of a base model: cases that share it share its runs.
std::string base_of(const BenchmarkTruth& truth) {
  std::string base = truth.family;
  for (const std::string& name : truth.known) base += ";" + name;
  return base;
}

/// Remembers runs as long as cases share the base model, and not without bound.
class Workflow {
 public:
  Diagnosis operator()(const BenchmarkTruth& truth, const Problem& problem) {
    const std::string wanted = base_of(truth);
    if (!store || wanted != base || store->size() > 20000)
      store = std::make_unique<RunStore>(), base = wanted;
    return diagnose(problem, *store);
  }

 private:
  std::unique_ptr<RunStore> store;
  std::string base;
};

std::string percent(double level) {
  std::ostringstream text;
  text << 100 * level << '%';
  return text.str();
}

/// What is counted.
class Table {
 public:
  void add(const BenchmarkCase& one, const BenchmarkOutcome& o) {
    const std::string at = "@" + percent(one.noise.level);
    if (one.kind == "hidden") {
      count("right" + at, o.right), count("wrong" + at, o.wrong), count("ambiguous" + at, o.ambiguous);
      count("none" + at, o.none), count("listed" + at, o.right || o.listed);
      count("right" + at + "/" + one.truth.hidden[0], o.right);
      if (o.right) before.push_back(o.gap_before), after.push_back(o.gap_after);
      if (o.places > 0) count("place-first", o.place_right > 0);
    } else if (one.kind.rfind("null", 0) == 0) {
      count("false-name@null", o.wrong);
      count(one.kind == "null" ? "false-name@null " + percent(one.noise.level) : "false-name@" + one.kind,
            o.wrong);
      count("none@null", o.none);
    } else if (one.kind == "outside") {
      count("flagged" + at, o.flagged), count("flagged-wrong" + at, o.wrong);
      if (o.exponents > 0)
        count("exponent-within-0.1", o.exponent_right > 0),
            count("exponent-within-0.1/" + one.truth.group, o.exponent_right > 0),
            count("exponent-interval-coverage", o.exponent_covered > 0);
    } else if (one.kind == "confounded") {
      count("confounded-listed", o.listed), count("confounded-resolved", o.resolved);
    } else if (one.kind == "two") {
      count("both" + at, o.right), count("both-wrong" + at, o.wrong);
    }
    for (int i = 0; i < o.intervals; ++i) count("interval-coverage", i < o.covered);
    if (o.confidence > 0) {
      Bin& bin = bins[std::min(9, static_cast<int>(10 * o.confidence))];
      ++bin.n, bin.confidence += o.confidence, bin.right += o.confidence_right;
    }
  }

  /// Expected calibration error over ten bins of confidence (Naeini, Cooper & Hauskrecht 2015).
  double calibration_error() const {
    double sum = 0;
    long n = 0;
    for (const Bin& bin : bins) sum += std::abs(bin.confidence - bin.right), n += bin.n;
    return n > 0 ? sum / n : 0;
  }

  std::vector<BenchResult> results(int ranks) const {
    std::vector<BenchResult> list;
    for (const BenchmarkFigure& f : figures) {
      const Interval interval = clopper_pearson(f.hits, f.of);
      list.push_back({"diagnose/" + f.name, f.value(), "of " + std::to_string(f.of), ranks});
      list.push_back({"diagnose/" + f.name + "/low", interval.low, "95 % interval", ranks});
      list.push_back({"diagnose/" + f.name + "/high", interval.high, "95 % interval", ranks});
    }
    list.push_back({"diagnose/calibration-error", calibration_error(), "1", ranks});
    list.push_back({"diagnose/gap-before", median(before), "chi2/n held out, median", ranks});
    list.push_back({"diagnose/gap-after", median(after), "chi2/n held out, median", ranks});
    return list;
  }

  void print(std::ostream& out) const {
    out << std::fixed << std::setprecision(4);
    for (const BenchmarkFigure& f : figures) {
      const Interval interval = clopper_pearson(f.hits, f.of);
      out << "  " << std::left << std::setw(36) << f.name << std::right << f.value() << "  [" << interval.low
          << ", " << interval.high << "]  " << f.hits << " of " << f.of << '\n';
    }
    out << "  calibration error " << calibration_error()
        << "; chi2/n on held-out conditions, median: " << median(before) << " -> " << median(after) << '\n'
        << std::defaultfloat;
  }

 private:
  void count(const std::string& name, bool hit) {
    auto found = std::find_if(figures.begin(), figures.end(), [&](const auto& f) { return f.name == name; });
    if (found == figures.end()) found = figures.insert(figures.end(), {name, 0, 0});
    found->hits += hit, ++found->of;
  }
  static double median(std::vector<double> values) {
    if (values.empty()) return 0;
    std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
    return values[values.size() / 2];
  }

  struct Bin {
    long n = 0;
    double confidence = 0, right = 0;
  };
  std::vector<BenchmarkFigure> figures;
  std::array<Bin, 10> bins;
  std::vector<double> before, after;
};

constexpr int width = 19;

std::array<double, width> packed(const BenchmarkOutcome& o) {
  return {double(o.right),
          double(o.wrong),
          double(o.none),
          double(o.ambiguous),
          double(o.flagged),
          double(o.input),
          double(o.listed),
          double(o.resolved),
          o.confidence,
          double(o.confidence_right),
          double(o.intervals),
          double(o.covered),
          double(o.places),
          double(o.place_right),
          double(o.exponents),
          double(o.exponent_right),
          o.gap_before,
          o.gap_after,
          double(o.exponent_covered)};
}

BenchmarkOutcome unpacked(const double* v) {
  BenchmarkOutcome o;
  o.right = v[0], o.wrong = v[1], o.none = v[2], o.ambiguous = v[3], o.flagged = v[4], o.input = v[5];
  o.listed = v[6], o.resolved = v[7], o.confidence = v[8], o.confidence_right = v[9];
  o.intervals = int(v[10]), o.covered = int(v[11]), o.places = int(v[12]), o.place_right = int(v[13]);
  o.exponents = int(v[14]), o.exponent_right = int(v[15]), o.gap_before = v[16], o.gap_after = v[17];
  o.exponent_covered = int(v[18]);
  return o;
}

/// As many cases of one base model as are handed to a rank together.
constexpr std::size_t largest_portion = 40;

std::vector<std::vector<BenchmarkCase>> portions_of(std::vector<BenchmarkCase> cases) {
  std::stable_sort(cases.begin(), cases.end(), [](const BenchmarkCase& a, const BenchmarkCase& b) {
    return base_of(a.truth) < base_of(b.truth);
  });
  std::vector<std::vector<BenchmarkCase>> portions;
  for (const BenchmarkCase& one : cases) {
    if (portions.empty() || portions.back().size() == largest_portion ||
        base_of(portions.back().back().truth) != base_of(one.truth))
      portions.emplace_back();
    portions.back().push_back(one);
  }
  return portions;
}

/// Adds lines "what was hidden : what was said" to the list of the folder.
void note_failures(const std::filesystem::path& folder, const std::string& text) {
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  std::ofstream(folder / ("not_as_hidden." + std::to_string(rank) + ".txt"), std::ios::app) << text;
}

std::string failures_in(const std::filesystem::path& folder) {
  std::map<std::string, int> count;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().filename().string().rfind("not_as_hidden.", 0) != 0) continue;
    std::ifstream list(entry.path());
    for (std::string line; std::getline(list, line);) ++count[line];
  }
  std::ostringstream text;
  for (const auto& [what, n] : count) text << "  " << n << " x " << what << '\n';
  return text.str();
}

}  // namespace

Interval clopper_pearson(long hits, long of, double confidence) {
  Interval interval{of > 0 ? static_cast<double>(hits) / of : 0, 0, 1};
  const double tail = 0.5 * (1 - confidence);
  const auto solve = [&](long k, double wanted) {  // upper_tail rises with p
    double low = 0, high = 1;
    for (int i = 0; i < 60; ++i) {
      const double p = 0.5 * (low + high);
      (upper_tail(k, of, p) < wanted ? low : high) = p;
    }
    return 0.5 * (low + high);
  };
  if (hits > 0) interval.low = solve(hits, tail);
  if (hits < of) interval.high = solve(hits + 1, 1 - tail);
  return interval;
}

std::vector<BenchResult> run_diagnosis_benchmark(long draws, const std::string& only,
                                                 const std::filesystem::path& kept, std::ostream& out) {
  int rank = 0, ranks = 1;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  std::vector<BenchmarkCase> cases = benchmark_cases(draws);
  cases.erase(std::remove_if(cases.begin(), cases.end(),
                             [&](const auto& one) { return one.label().find(only) == std::string::npos; }),
              cases.end());
  if (cases.empty())
    throw InputError("bench diagnose: --only \"" + only +
                     "\": no case has these words. Try the name of an effect, \"null\", \"outside\", "
                     "\"confounded\" or \"two\".");
  const std::vector<std::vector<BenchmarkCase>> portions = portions_of(cases);
  int id = getpid();
  MPI_Bcast(&id, 1, MPI_INT, 0, MPI_COMM_WORLD);
  const auto folder =
      kept.empty() ? std::filesystem::temp_directory_path() / ("seedflow-bench-" + std::to_string(id)) : kept;
  const auto prm = folder / "benchmark.prm";
  RunStore results(folder, MPI_COMM_WORLD);
  together(MPI_COMM_WORLD, [&] {
    if (rank == 0) write_benchmark_base(prm);
  });

  Workflow workflow;
  Progress progress("diagnoses", static_cast<double>(portions.size()), 0, rank);
  std::vector<RunStore::Task> tasks;
  for (std::size_t p = 0; p < portions.size(); ++p) {
    std::string key;
    for (const BenchmarkCase& one : portions[p]) key += "|" + std::to_string(one.draw);
    tasks.push_back({key, [&, p] {
                       std::vector<double> numbers;
                       std::string failures;
                       for (const BenchmarkCase& one : portions[p]) {
                         const BenchmarkOutcome o = judge(
                             one, [&](const Problem& problem) { return workflow(one.truth, problem); }, prm);
                         const auto row = packed(o);
                         numbers.insert(numbers.end(), row.begin(), row.end());
                         const bool good = one.kind == "outside"      ? o.flagged
                                           : one.kind == "confounded" ? o.resolved
                                           : one.truth.hidden.empty() ? o.none
                                                                      : o.right;
                         if (!good) failures += one.label() + " : " + o.answer + "\n";
                       }
                       note_failures(folder, failures);
                       progress.update(static_cast<double>(p));
                       return numbers;
                     }});
  }
  results.share(tasks);
  progress.finish();

  Table table;
  std::string failures;
  together(MPI_COMM_WORLD, [&] {
    for (std::size_t p = 0; p < portions.size(); ++p) {
      const RunOutcome& outcome = results.get(tasks[p].key, tasks[p].run);
      if (!outcome.ok()) throw RunError("The benchmark failed: " + outcome.error);
      for (std::size_t i = 0; i < portions[p].size(); ++i)
        table.add(portions[p][i], unpacked(&outcome.values[i * width]));
    }
    if (rank == 0) failures = failures_in(folder);
  });
  if (rank != 0) return {};
  if (kept.empty()) std::filesystem::remove_all(folder);
  out << "Not as hidden:\n" << failures;
  table.print(out);
  return table.results(ranks);
}

}  // namespace seedflow
