// The same observables on 1, 2 and 3 ranks.
#include <cmath>

#include "tiny_run.h"

namespace seedflow {
namespace {

class Ranks : public TinyRun {
 protected:
  /// Largest difference of the vector quantities in seeds.csv, relative to their largest length.
  static double difference(const Series& a, const Series& b, const std::string& quantity) {
    double scale = 0, largest = 0;
    for (std::size_t i = 0; i < a.n_rows(); ++i) {
      double length = 0;
      for (const char* axis : {" x", " y", " z"}) {
        const double left = a[quantity + axis][i], right = b[quantity + axis][i];
        length += left * left;
        largest = std::max(largest, std::abs(left - right));
      }
      scale = std::max(scale, std::sqrt(length));
    }
    return largest / scale;
  }
  void expect_same_observables(const std::vector<std::string>& set) const {
    ASSERT_EQ(run_program(set, "1").status, exit_done);
    const Series one = read_series(out("1") / "seeds.csv");
    const Summary first = Summary::read(out("1") / "summary.json");
    for (const int ranks : {2, 3}) {
      SCOPED_TRACE(ranks);
      const std::string name = std::to_string(ranks);
      ASSERT_EQ(run_program(set, name, ranks).status, exit_done);
      const Series more = read_series(out(name) / "seeds.csv");
      ASSERT_EQ(more.n_rows(), one.n_rows());
      // Sums run in another order and the solvers stop at 1e-9 (pressure) and 1e-11 (velocity).
      for (const char* quantity : {"position", "velocity", "air force", "air velocity"}) {
        EXPECT_LE(difference(one, more, quantity), 1e-8) << quantity;
        RecordProperty(quantity, std::to_string(difference(one, more, quantity)));
      }
      const Summary other = Summary::read(out(name) / "summary.json");
      ASSERT_EQ(other.observables().size(), first.observables().size());
      for (const auto& o : first.observables())
        EXPECT_NEAR(other.observable(o.name), o.value, 1e-8 * std::abs(o.value)) << o.name;
    }
  }
};

TEST_F(Ranks, GaussianKernel) {
  expect_same_observables({"Effects/Added mass/Strength=1"});
}

TEST_F(Ranks, LiteralModel) {
  expect_same_observables(literal_model);
}

}  // namespace
}  // namespace seedflow
