#include "seedflow/diagnose/run_store.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "seedflow/base/error.h"

namespace seedflow {
namespace {

std::filesystem::path fresh_folder(const std::string& name) {
  const auto folder = std::filesystem::temp_directory_path() / ("seedflow_" + name);
  std::filesystem::remove_all(folder);
  return folder;
}

TEST(RunStore, AFinishedRunIsNeverRepeated) {
  const auto folder = fresh_folder("run_store");
  int runs = 0;
  const auto run = [&] { return ++runs, std::vector<double>{0.1, 1e-300, -3}; };
  {
    RunStore store(folder);
    EXPECT_EQ(store.get("a", run).values[0], 0.1);
    store.get("a", run);
    EXPECT_EQ(runs, 1);
  }
  RunStore again(folder);
  EXPECT_EQ(again.get("a", run).values, (std::vector<double>{0.1, 1e-300, -3}));
  EXPECT_EQ(runs, 1);
  EXPECT_EQ(again.computed(), 0);
}

TEST(RunStore, RunsOfAnotherBuildAreUsedOnlyIfAskedFor) {
  const auto folder = fresh_folder("run_store_builds");
  const auto gives = [](double value) { return [value] { return std::vector<double>{value}; }; };
  {
    RunStore store(folder, MPI_COMM_SELF, OtherBuilds::ignore, "old");
    store.get("a", gives(1)), store.get("b", gives(2));
  }
  {
    RunStore store(folder, MPI_COMM_SELF, OtherBuilds::use, "new");
    EXPECT_EQ(store.of_other_builds(), 2);
    EXPECT_EQ(store.get("b", gives(3)).values[0], 2);
  }
  {
    RunStore store(folder, MPI_COMM_SELF, OtherBuilds::ignore, "new");
    EXPECT_EQ(store.of_other_builds(), 2);
    EXPECT_FALSE(store.remembers("a"));
    EXPECT_EQ(store.get("a", gives(4)).values[0], 4);
  }
  RunStore store(folder, MPI_COMM_SELF, OtherBuilds::use, "new");
  EXPECT_EQ(store.of_other_builds(), 1);
  EXPECT_EQ(store.get("a", gives(5)).values[0], 4);
}

TEST(RunStoreMpi, SharedRunsAreMadeOnceAndKnownToAll) {
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  const auto folder = std::filesystem::temp_directory_path() / "seedflow_run_store_shared";
  if (rank == 0) std::filesystem::remove_all(folder);
  MPI_Barrier(MPI_COMM_WORLD);
  int mine = 0, all = 0;
  std::vector<RunStore::Task> tasks;
  for (int i = 0; i < 20; ++i)
    tasks.push_back({std::to_string(i), [&mine, i] { return ++mine, std::vector<double>{0.1 * i}; }});
  {
    RunStore store(folder, MPI_COMM_WORLD);
    store.share(tasks);
    MPI_Allreduce(&mine, &all, 1, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
    EXPECT_EQ(all, 20);
    for (int i = 0; i < 20; ++i) EXPECT_EQ(store.get(tasks[i].key, tasks[i].run).values[0], 0.1 * i);
  }
  // What every rank wrote is read again, whatever their number.
  RunStore again(folder, MPI_COMM_WORLD);
  EXPECT_EQ(again.size(), 20u);
}

TEST(RunStore, ALineCutOffByAKilledProcessIsIgnored) {
  const auto folder = fresh_folder("run_store_cut");
  {
    RunStore store(folder);
    store.get("whole", [] { return std::vector<double>{1}; });
  }
  std::ofstream(folder / "runs.jsonl", std::ios::app) << "{\"key\":\"cut\",\"val";
  {
    RunStore store(folder);
    EXPECT_EQ(store.size(), 1u);
    store.get("next", [] { return std::vector<double>{2}; });
  }
  RunStore store(folder);
  EXPECT_EQ(store.size(), 2u);
  EXPECT_EQ(store.get("next", [] { return std::vector<double>{7}; }).values[0], 2);
}

TEST(RunStore, FailuresAreRecordedAndSurvived) {
  const auto folder = fresh_folder("run_store_failed");
  {
    RunStore store(folder);
    EXPECT_EQ(store.get("crash", []() -> std::vector<double> { throw RunError("it burst"); }).error,
              "it burst");
    EXPECT_FALSE(store.get("nan", [] { return std::vector<double>{1, std::nan("")}; }).ok());
  }
  RunStore store(folder);
  EXPECT_EQ(store.get("crash", [] { return std::vector<double>{1}; }).error, "it burst");
  EXPECT_THROW(store.get("stop", []() -> std::vector<double> { throw Interrupted(); }), Interrupted);
  EXPECT_EQ(store.size(), 2u);
}

}  // namespace
}  // namespace seedflow
