#include "seedflow/output/summary.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "seedflow/output/json.h"
#include "testing.h"

namespace seedflow {
namespace {

const double nan_value = std::numeric_limits<double>::quiet_NaN();

Summary example() {
  Summary summary;
  summary.text("experiment", "settling");
  summary.observe("terminal_velocity", 0.1018, "m/s");
  summary.observe("velocity_0.05s", 1.0 / 3, "m/s");
  summary.conserve("momentum exchange", 3e-14, 1e-12);
  summary.conserve("mass of the air", -2e-10);
  summary.performance = {1.5, 120, 2.5e7, 3e5};
  return summary;
}

TEST(Summary, HasTheDocumentedMembers) {
  TemporaryFolder folder;
  example().write(folder / "summary.json");
  const Json json = read_json(folder / "summary.json");
  EXPECT_EQ(json.at("observables").at("terminal_velocity").at("value"), 0.1018);
  EXPECT_EQ(json.at("observables").at("terminal_velocity").at("unit"), "m/s");
  EXPECT_EQ(json.at("conservation").at("momentum exchange"), 3e-14);
  EXPECT_EQ(json.at("conservation_limits").at("momentum exchange"), 1e-12);
  EXPECT_FALSE(json.at("conservation_limits").contains("mass of the air"));
  EXPECT_EQ(json.at("performance").at("wall_time_s"), 1.5);
  EXPECT_EQ(json.at("performance").at("peak_memory_MiB"), 120);
  EXPECT_EQ(json.at("performance").at("sub_sphere_steps_per_second_per_core"), 2.5e7);
  EXPECT_EQ(json.at("performance").at("cell_steps_per_second_per_core"), 3e5);
  EXPECT_EQ(json.at("texts").at("experiment"), "settling");
}

TEST(Summary, ReadsBackTheSame) {
  TemporaryFolder folder;
  example().write(folder / "summary.json");
  const Summary back = Summary::read(folder / "summary.json");
  EXPECT_EQ(back.observable("velocity_0.05s"), 1.0 / 3);
  ASSERT_EQ(back.balances().size(), 2u);
  EXPECT_EQ(back.balances()[0].limit, 1e-12);
  EXPECT_TRUE(std::isinf(back.balances()[1].limit));
  EXPECT_EQ(back.performance.cell_steps_per_second_per_core, 3e5);
  EXPECT_CONTAINS(message_of<InputError>([&] { back.observable("speed"); }), "'terminal_velocity'");
  write_text(folder / "other.json", "{\"observables\": {}}");
  EXPECT_CONTAINS(message_of<InputError>([&] { Summary::read(folder / "other.json"); }), "not the summary");
}

TEST(Summary, BrokenBalancesAreFoundIncludingNotANumber) {
  Summary summary = example();
  EXPECT_TRUE(summary.violations().empty());
  EXPECT_NO_THROW(summary.require_conservation());
  summary.conserve("momentum exchange", -3e-12, 1e-12);  // the sign does not matter
  summary.conserve("energy", nan_value);                 // even without a limit
  ASSERT_EQ(summary.violations().size(), 2u);
  const std::string message = message_of<RunError>([&] { summary.require_conservation(); });
  EXPECT_CONTAINS(message, "momentum exchange");
  EXPECT_CONTAINS(message, "3e-12");
  EXPECT_CONTAINS(message, "1e-12");
  EXPECT_CONTAINS(message, "energy");
}

TEST(Summary, ABrokenBalanceIsStillWrittenAndAMissingObservableIsNot) {
  TemporaryFolder folder;
  Summary summary = example();
  summary.conserve("energy", nan_value, 1e-3);
  summary.write(folder / "summary.json");
  EXPECT_EQ(Summary::read(folder / "summary.json").violations().size(), 1u);
  summary.observe("terminal_velocity", nan_value, "m/s");
  EXPECT_CONTAINS(message_of<RunError>([&] { summary.write(folder / "bad.json"); }), "terminal_velocity");
}

TEST(Summary, PeakMemoryGrowsByWhatIsTouched) {
  const double before = peak_memory_MiB();
  constexpr std::size_t bytes = std::size_t(256) << 20;
  const std::vector<char> block(bytes, 1);
  // 256 MiB more, less what was touched and freed before.
  EXPECT_GT(peak_memory_MiB(), std::max(before, 250.0));
  EXPECT_EQ(block[bytes / 2], 1);
}

TEST(SummaryMpi, MemoryIsTheSumOverTheRanks) {
  int size = 1;
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  const double sum = peak_memory_MiB(MPI_COMM_WORLD), mine = peak_memory_MiB();
  double all = 0;
  MPI_Allreduce(&mine, &all, 1, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
  // The peak may have grown by a page or two in between.
  EXPECT_NEAR(sum, all, 1.0 * size);
}

}  // namespace
}  // namespace seedflow
