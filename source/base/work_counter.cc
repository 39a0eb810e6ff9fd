#include "seedflow/base/work_counter.h"

namespace seedflow {

WorkCounter::WorkCounter(MPI_Comm comm) {
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  long* memory = nullptr;
  // The count lives on the first rank.
  MPI_Win_allocate(rank == 0 ? sizeof(long) : 0, sizeof(long), MPI_INFO_NULL, comm, &memory, &window);
  if (rank == 0) {
    MPI_Win_lock(MPI_LOCK_EXCLUSIVE, 0, 0, window);
    *memory = 0;
    MPI_Win_unlock(0, window);
  }
  MPI_Barrier(comm);
}

WorkCounter::~WorkCounter() {
  MPI_Win_free(&window);
}

long WorkCounter::next() {
  const long one = 1;
  long number = 0;
  MPI_Win_lock(MPI_LOCK_SHARED, 0, 0, window);
  MPI_Fetch_and_op(&one, &number, MPI_LONG, 0, 0, MPI_SUM, window);
  MPI_Win_unlock(0, window);
  return number;
}

}  // namespace seedflow
