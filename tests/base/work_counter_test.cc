// Every number is handed out once, to some rank.
#include "seedflow/base/work_counter.h"

#include <gtest/gtest.h>

#include <vector>

namespace seedflow {
namespace {

TEST(WorkCounterMpi, HandsOutEveryNumberOnce) {
  constexpr int n = 100;
  std::vector<int> mine(n, 0), all(n, 0);
  {
    WorkCounter counter(MPI_COMM_WORLD);
    for (long i = counter.next(); i < n; i = counter.next()) ++mine[i];
  }
  MPI_Allreduce(mine.data(), all.data(), n, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
  EXPECT_EQ(all, std::vector<int>(n, 1));
}

}  // namespace
}  // namespace seedflow
