#include "seedflow/base/together.h"

#include <string>

#include "seedflow/base/error.h"

namespace seedflow {

void together(MPI_Comm communicator, const std::function<void()>& work) {
  enum Kind : char { none = '-', input = 'i', run = 'r' };
  int rank = 0, ranks = 1;
  MPI_Comm_rank(communicator, &rank);
  MPI_Comm_size(communicator, &ranks);
  std::string failure(1, none);
  try {
    work();
  } catch (const InputError& error) {
    failure = static_cast<char>(input) + std::string(error.what());
  } catch (const std::exception& error) {
    failure = static_cast<char>(run) + std::string(error.what());
  }
  const int mine = failure[0] == none ? ranks : rank;
  int first = 0;
  MPI_Allreduce(&mine, &first, 1, MPI_INT, MPI_MIN, communicator);
  if (first == ranks) return;
  unsigned long long length = failure.size();
  MPI_Bcast(&length, 1, MPI_UNSIGNED_LONG_LONG, first, communicator);
  failure.resize(length);
  MPI_Bcast(failure.data(), static_cast<int>(length), MPI_CHAR, first, communicator);
  if (failure[0] == input) throw InputError(failure.substr(1));
  throw RunError(failure.substr(1));
}

}  // namespace seedflow
