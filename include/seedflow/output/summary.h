#pragma once

#include <mpi.h>

#include <filesystem>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace seedflow {

/// summary.json: what a run found, how well it kept its balances and how fast it was.
///
///   { "texts":        { name: words },                    experiment, verdict, ...
///     "observables":  { name: { "value": v, "unit": u } },
///     "conservation": { name: relative error },
///     "conservation_limits": { name: limit },
///     "performance":  { "wall_time_s", "peak_memory_MiB", "sub_sphere_steps_per_second_per_core",
///                       "cell_steps_per_second_per_core" } }
///
/// Names are unique; adding one again replaces its value.
class Summary {
 public:
  struct Observable {
    std::string name;
    double value;
    std::string unit;
  };
  struct Balance {
    std::string name;
    double relative_error;
    double limit;  ///< infinity: reported only
  };
  struct Performance {
    double wall_time_s = 0;
    double peak_memory_MiB = 0;  ///< added up over all ranks
    double sub_sphere_steps_per_second_per_core = 0;
    double cell_steps_per_second_per_core = 0;
  };

  void text(const std::string& name, const std::string& words);
  void observe(const std::string& name, double value, const std::string& unit);
  /// A balance with the limit its magnitude must stay within.
  void conserve(const std::string& name, double relative_error,
                double limit = std::numeric_limits<double>::infinity());
  Performance performance;

  const std::vector<Observable>& observables() const { return all_observables; }
  const std::vector<Balance>& balances() const { return all_balances; }
  const std::vector<std::pair<std::string, std::string>>& texts() const { return all_texts; }
  /// Errors: InputError listing the names there are.
  double observable(const std::string& name) const;

  /// One sentence per balance that is broken (beyond its limit, or not a number); empty if all hold.
  std::vector<std::string> violations() const;
  /// Throws RunError with all violations, if there are any. Call after write(), so that the numbers are kept.
  void require_conservation() const;

  /// Errors: RunError naming an observable that is not finite; a balance that is not finite is written as
  /// null.
  void write(const std::filesystem::path& file) const;
  /// Errors: InputError if the file is missing, malformed, or lacks a member.
  static Summary read(const std::filesystem::path& file);

 private:
  std::vector<std::pair<std::string, std::string>> all_texts;
  std::vector<Observable> all_observables;
  std::vector<Balance> all_balances;
};

/// The largest resident memory this process has had [MiB] (getrusage).
double peak_memory_MiB();
/// Added up over the ranks of `comm`; the same on all of them. Collective.
double peak_memory_MiB(MPI_Comm comm);

}  // namespace seedflow
