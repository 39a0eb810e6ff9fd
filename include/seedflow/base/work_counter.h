#pragma once

#include <mpi.h>

namespace seedflow {

/// Numbers 0, 1, 2, ... handed out to the ranks of a communicator, each once, whoever asks first: work of
/// unequal size is shared evenly. Constructor and destructor are collective, next() is not.
class WorkCounter {
 public:
  explicit WorkCounter(MPI_Comm comm);
  ~WorkCounter();
  WorkCounter(const WorkCounter&) = delete;
  WorkCounter& operator=(const WorkCounter&) = delete;

  long next();

 private:
  MPI_Win window;
};

}  // namespace seedflow
