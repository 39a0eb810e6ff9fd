#include <gtest/gtest.h>
#include <mpi.h>

#include <cstring>

#include "checkpoint_child.h"

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  int status = 0;
  if (argc == 3 && std::strcmp(argv[1], "--write-checkpoints") == 0) {
    seedflow::write_checkpoints_until_killed(argv[2]);
  } else {
    ::testing::InitGoogleTest(&argc, argv);
    status = RUN_ALL_TESTS();
  }
  MPI_Finalize();
  return status;
}
