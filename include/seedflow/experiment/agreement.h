#pragma once

#include <mpi.h>

#include <functional>
#include <iosfwd>

namespace seedflow {

/// Runs `work` on every rank of the communicator and turns what it throws into an ExitStatus, the same on all
/// ranks: the gravest of them (failed, bad input, interrupted, done). Each different message is written once,
/// to `errors` of rank 0.
///
/// A rank that fails alone leaves the others waiting for it inside a collective call, which nothing but
/// ending them can resolve: if they do not arrive within `patience` seconds, the rank writes its own message
/// and ends all of them by MPI_Abort with its status.
int run_in_agreement(MPI_Comm communicator, const std::function<int()>& work, std::ostream& errors,
                     double patience = 10);

/// Whether all ranks call this within `patience` seconds of each other. The communicator must be used for
/// nothing else while one of the ranks may be on its way.
bool all_ranks_arrive(MPI_Comm communicator, double patience);

/// Where the ranks find each other when one of them may have failed alone and the others still communicate
/// elsewhere: a communicator of its own.
class Meeting {
 public:
  explicit Meeting(MPI_Comm comm) { MPI_Comm_dup(comm, &own); }
  ~Meeting() {
    if (complete) MPI_Comm_free(&own);  // waits for all
  }
  Meeting(const Meeting&) = delete;
  Meeting& operator=(const Meeting&) = delete;
  /// As all_ranks_arrive().
  bool all_arrive(double patience) { return complete = all_ranks_arrive(own, patience); }
  MPI_Comm comm() const { return own; }

 private:
  MPI_Comm own;
  bool complete = true;
};

}  // namespace seedflow
