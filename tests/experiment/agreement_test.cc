#include "seedflow/experiment/agreement.h"

#include <gtest/gtest.h>

#include <new>
#include <sstream>

#include "places.h"
#include "seedflow/base/error.h"
#include "shell.h"

namespace seedflow {
namespace {

struct Outcome {
  int status;
  std::string errors;
};

Outcome agree(MPI_Comm communicator, const std::function<int()>& work) {
  std::ostringstream errors;
  const int status = run_in_agreement(communicator, work, errors);
  return {status, errors.str()};
}

TEST(Agreement, ExceptionsBecomeExitStatus) {
  const auto status_of = [](const std::function<int()>& work) { return agree(MPI_COMM_SELF, work).status; };
  EXPECT_EQ(status_of([] { return 0; }), 0);
  EXPECT_EQ(status_of([]() -> int { throw InputError("x"); }), 2);
  EXPECT_EQ(status_of([]() -> int { throw RunError("x"); }), 3);
  EXPECT_EQ(status_of([]() -> int { throw Interrupted(); }), 130);
  EXPECT_EQ(status_of([]() -> int { throw std::bad_alloc(); }), 3);
  EXPECT_EQ(status_of([]() -> int { throw std::out_of_range("x"); }), 3);
  EXPECT_EQ(status_of([] { return 130; }), 130);
}

TEST(Agreement, MessageIsWrittenAsItIs) {
  EXPECT_EQ(agree(MPI_COMM_SELF, []() -> int { throw InputError("x.prm:1: bad"); }).errors, "x.prm:1: bad\n");
  EXPECT_EQ(agree(MPI_COMM_SELF, [] { return 0; }).errors, "");
}

int rank_of_world() {
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  return rank;
}
int ranks_of_world() {
  int ranks = 1;
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  return ranks;
}

TEST(AgreementMpi, OneMessageForTheSameErrorOnAllRanks) {
  const Outcome outcome = agree(MPI_COMM_WORLD, []() -> int { throw InputError("bad"); });
  EXPECT_EQ(outcome.status, 2);
  EXPECT_EQ(outcome.errors, rank_of_world() == 0 ? "bad\n" : "");
}

TEST(AgreementMpi, ErrorOfOneRankIsTheErrorOfAll) {
  const int last = ranks_of_world() - 1;
  const Outcome outcome = agree(MPI_COMM_WORLD, [&]() -> int {
    if (rank_of_world() == last) throw RunError("no convergence");
    return 0;
  });
  EXPECT_EQ(outcome.status, 3);
  const std::string named =
      last == 0 ? "" : "Rank " + std::to_string(last) + " of " + std::to_string(last + 1) + ": ";
  EXPECT_EQ(outcome.errors, rank_of_world() == 0 ? named + "no convergence\n" : "");
}

TEST(AgreementMpi, TheGravestErrorDecides) {
  const Outcome outcome = agree(MPI_COMM_WORLD, []() -> int {
    if (rank_of_world() == 0) throw Interrupted();
    throw RunError("failed");
  });
  EXPECT_EQ(outcome.status, ranks_of_world() == 1 ? 130 : 3);
}

// Without MPI_Abort this would wait for ever: rank 0 stands in a barrier which rank 1 never reaches.
TEST(Agreement, RankThatFailsAloneEndsTheOthers) {
  const auto folder =
      std::filesystem::temp_directory_path() / ("seedflow_agreement_" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  const std::string self = std::filesystem::read_symlink("/proc/self/exe").string();
  const ShellResult result =
      run_in_shell(std::string("timeout 60 ") + places::mpiexec +
                       " --allow-run-as-root --oversubscribe -q -n 2 '" + self + "' --fail-on-one-rank",
                   folder);
  EXPECT_EQ(result.status, 3);
  EXPECT_NE(result.err.find("Rank 1 of 2: this rank alone failed"), std::string::npos) << result.err;
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace seedflow
