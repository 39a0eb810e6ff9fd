#pragma once

#include <mpi.h>

#include <algorithm>
#include <vector>

#include "seedflow/seeds/seed_share.h"

namespace seedflow {

/// The maximum of a number over all ranks, asked for now and waited for later, when the others' numbers have
/// long arrived. Every rank sends to every other: a tree, as in MPI_Iallreduce, goes on only while the ranks
/// on its way are inside MPI, and they compute.
class LateMaximum {
 public:
  void start(const SeedShare& share, double own) {
    pending = true;
    number.assign(share.n_ranks(), own);
    requests.clear();
    const double* const sent = &number[share.rank()];
    for (int r = 0; r < share.n_ranks(); ++r) {
      if (r == share.rank()) continue;
      MPI_Irecv(&number[r], 1, MPI_DOUBLE, r, tag, share.communicator(), &requests.emplace_back());
      MPI_Isend(sent, 1, MPI_DOUBLE, r, tag, share.communicator(), &requests.emplace_back());
    }
  }
  bool is_pending() const { return pending; }
  double finish() {
    if (!requests.empty())
      MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
    pending = false;
    return *std::max_element(number.begin(), number.end());
  }

 private:
  static constexpr int tag = 1;  // 0 has the GhostExchange

  std::vector<double> number;  ///< [rank]
  std::vector<MPI_Request> requests;
  bool pending = false;
};

}  // namespace seedflow
