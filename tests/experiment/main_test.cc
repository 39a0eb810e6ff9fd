#include <deal.II/base/mpi.h>
#include <gtest/gtest.h>

#include <iostream>

#include "seedflow/base/error.h"
#include "seedflow/experiment/agreement.h"

/// The program which Agreement.RankThatFailsAloneEndsTheOthers starts on two ranks: one throws, the other
/// waits for it.
static int fail_on_one_rank() {
  return seedflow::run_in_agreement(
      MPI_COMM_WORLD,
      []() -> int {
        if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 1)
          throw seedflow::RunError("this rank alone failed");
        MPI_Barrier(MPI_COMM_WORLD);
        return seedflow::exit_done;
      },
      std::cerr, 0.5);
}

int main(int argc, char** argv) {
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  if (argc > 1 && std::string(argv[1]) == "--fail-on-one-rank") return fail_on_one_rank();
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
