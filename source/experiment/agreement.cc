#include "seedflow/experiment/agreement.h"

#include <time.h>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <string>
#include <vector>

#include "seedflow/base/error.h"

namespace seedflow {
namespace {

struct Outcome {
  int status = exit_done;
  std::string message;
};

Outcome outcome_of(const std::function<int()>& work) {
  try {
    return {work(), ""};
  } catch (const InputError& error) {
    return {exit_bad_input, error.what()};
  } catch (const RunError& error) {
    return {exit_failed, error.what()};
  } catch (const Interrupted&) {
    return {exit_interrupted, ""};  // who catches it first has written the checkpoint and said so
  } catch (const std::bad_alloc&) {
    return {exit_failed,
            "The memory of this machine is not enough. Use a coarser mesh, fewer seeds or more machines."};
  } catch (const std::exception& error) {
    return {exit_failed, std::string("Unexpected failure: ") + error.what()};
  }
}

int gravity(int status) {
  switch (status) {
    case exit_done:
      return 0;
    case exit_interrupted:
      return 1;
    case exit_bad_input:
      return 2;
    default:
      return 3;
  }
}

std::vector<std::string> gather(MPI_Comm communicator, const std::string& text) {
  int rank = 0, ranks = 1;
  MPI_Comm_rank(communicator, &rank);
  MPI_Comm_size(communicator, &ranks);
  const int length = static_cast<int>(text.size());
  std::vector<int> lengths(static_cast<std::size_t>(ranks)), offsets(static_cast<std::size_t>(ranks));
  MPI_Gather(&length, 1, MPI_INT, lengths.data(), 1, MPI_INT, 0, communicator);
  int total = 0;
  for (std::size_t r = 0; r < lengths.size(); ++r) {
    offsets[r] = total;
    total += lengths[r];
  }
  std::string all(static_cast<std::size_t>(total), '\0');
  MPI_Gatherv(text.data(), length, MPI_CHAR, all.data(), lengths.data(), offsets.data(), MPI_CHAR, 0,
              communicator);
  std::vector<std::string> texts;
  if (rank == 0)
    for (std::size_t r = 0; r < lengths.size(); ++r)
      texts.push_back(all.substr(static_cast<std::size_t>(offsets[r]), static_cast<std::size_t>(lengths[r])));
  return texts;
}

}  // namespace

bool all_ranks_arrive(MPI_Comm communicator, double patience) {
  MPI_Request request;
  MPI_Ibarrier(communicator, &request);
  const double begin = MPI_Wtime();
  for (;;) {
    int done = 0;
    MPI_Test(&request, &done, MPI_STATUS_IGNORE);
    if (done) return true;
    if (MPI_Wtime() - begin > patience) return false;
    const timespec pause{0, 1000000};
    nanosleep(&pause, nullptr);
  }
}

int run_in_agreement(MPI_Comm communicator, const std::function<int()>& work, std::ostream& errors,
                     double patience) {
  int rank = 0, ranks = 1;
  MPI_Comm_rank(communicator, &rank);
  MPI_Comm_size(communicator, &ranks);
  // Own communicator, so that these messages cannot meet ones which a failed rank left behind.
  MPI_Comm own;
  MPI_Comm_dup(communicator, &own);

  const Outcome mine = outcome_of(work);
  // Ranks without an error wait as long as it takes.
  if (!all_ranks_arrive(own, mine.status != exit_done ? patience : HUGE_VAL)) {
    errors << "Rank " << rank << " of " << ranks << ": " << mine.message << "\nThe other ranks are ended."
           << std::endl;
    MPI_Abort(communicator, mine.status);
  }

  const std::vector<std::string> messages = gather(own, mine.message);
  std::vector<std::string> written;
  for (std::size_t r = 0; r < messages.size(); ++r) {
    if (messages[r].empty() || std::find(written.begin(), written.end(), messages[r]) != written.end())
      continue;
    const bool everywhere = std::count(messages.begin(), messages.end(), messages[r]) == ranks;
    if (!everywhere) errors << "Rank " << r << " of " << ranks << ": ";
    errors << messages[r] << std::endl;
    written.push_back(messages[r]);
  }

  std::vector<int> statuses(static_cast<std::size_t>(ranks));
  MPI_Allgather(&mine.status, 1, MPI_INT, statuses.data(), 1, MPI_INT, own);
  MPI_Comm_free(&own);
  return *std::max_element(statuses.begin(), statuses.end(),
                           [](int a, int b) { return gravity(a) < gravity(b); });
}

}  // namespace seedflow
