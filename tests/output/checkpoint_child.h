#pragma once

#include <filesystem>
#include <ostream>
#include <vector>

#include "seedflow/output/checkpoint.h"

namespace seedflow {

/// What state number k looks like: its time is k, its stream holds this many copies of k.
inline std::vector<double> numbered_state(int k) {
  return std::vector<double>(20000 + 1000 * (k % 7), k);
}

inline void write_numbered_checkpoint(const std::filesystem::path& folder, int k, MPI_Comm comm) {
  CheckpointWriter writer(folder, k, "set Number = 1\n", comm);
  const std::vector<double> state = numbered_state(k);
  writer.stream("state").write(reinterpret_cast<const char*>(state.data()),
                               static_cast<std::streamsize>(state.size() * sizeof(double)));
  writer.commit();
}

/// The body of the process that a test kills at an arbitrary moment.
[[noreturn]] inline void write_checkpoints_until_killed(const std::filesystem::path& folder) {
  for (int k = 1;; ++k) write_numbered_checkpoint(folder, k, MPI_COMM_SELF);
}

}  // namespace seedflow
