#include "seedflow/base/interrupt.h"

#include <gtest/gtest.h>
#include <signal.h>

namespace seedflow {
namespace {

TEST(Interrupt, NothingHappensWithoutASignal) {
  const InterruptGuard guard(MPI_COMM_SELF);
  EXPECT_FALSE(guard.requested());
  EXPECT_NO_THROW(guard.check());
}

TEST(Interrupt, EachSignalInterrupts) {
  for (const int number : {SIGINT, SIGTERM, SIGUSR1}) {
    const InterruptGuard guard(MPI_COMM_SELF);
    raise(number);
    EXPECT_TRUE(guard.requested());
    EXPECT_THROW(guard.check(), Interrupted);
  }
}

// A study runs simulations with guards of their own: the signal must reach the outer one as well.
TEST(Interrupt, NestedGuardsShareTheSignal) {
  const InterruptGuard outer(MPI_COMM_SELF);
  {
    const InterruptGuard inner(MPI_COMM_SELF);
    raise(SIGTERM);
    EXPECT_TRUE(inner.requested());
  }
  EXPECT_TRUE(outer.requested());
}

TEST(Interrupt, PreviousHandlersReturn) {
  struct sigaction before, during, after;
  sigaction(SIGTERM, nullptr, &before);
  {
    const InterruptGuard guard(MPI_COMM_SELF);
    sigaction(SIGTERM, nullptr, &during);
  }
  sigaction(SIGTERM, nullptr, &after);
  EXPECT_NE(during.sa_handler, before.sa_handler);
  EXPECT_EQ(after.sa_handler, before.sa_handler);
}

// Only the last rank is signalled; all leave at the same check.
TEST(InterruptMpi, RanksAgree) {
  int rank = 0, ranks = 1;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  const InterruptGuard guard(MPI_COMM_WORLD);
  int step = 0;
  try {
    for (; step < 10; ++step) {
      if (step == 4 && rank == ranks - 1) raise(SIGTERM);
      guard.check();
    }
  } catch (const Interrupted&) {
  }
  EXPECT_EQ(step, 4);
}

}  // namespace
}  // namespace seedflow
