#include <gtest/gtest.h>
#include <mpi.h>

#include <cstring>
#include <string>

#include "checkpoint_child.h"

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  const bool child = argc == 3 && std::strcmp(argv[1], "--write-checkpoints") == 0;
  // Starting MPI takes longer than most tests: one that is run alone and does without it skips that.
  const std::string filter = ::testing::GTEST_FLAG(filter);
  const bool with_mpi = child || filter.find_first_of("*-:") != std::string::npos ||
                        filter.find("Mpi") != std::string::npos || filter.rfind("Checkpoint", 0) == 0;
  if (with_mpi) MPI_Init(&argc, &argv);
  if (child) seedflow::write_checkpoints_until_killed(argv[2]);
  const int status = RUN_ALL_TESTS();
  if (with_mpi) MPI_Finalize();
  return status;
}
