#pragma once

#include <mpi.h>

#include "seedflow/base/error.h"

namespace seedflow {

/// While an object of this class lives, SIGINT and SIGTERM (and SIGUSR1, which is what mpirun forwards to its
/// processes) do not end the process but set a flag. Several ranks see the signal at different moments, or
/// only one of them sees it at all; therefore check() is collective and all ranks leave at the same step.
///
/// Signals belong to the process: the flag is the one variable here that is not owned by an object, because a
/// signal handler can reach nothing else. Objects may be nested; the previous handlers return with the
/// outermost one.
class InterruptGuard {
 public:
  explicit InterruptGuard(MPI_Comm communicator);
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  /// Whether any rank was signalled. Collective.
  bool requested() const;
  /// Throws Interrupted on all ranks if any was signalled. Collective.
  void check() const;

 private:
  MPI_Comm communicator;
};

}  // namespace seedflow
