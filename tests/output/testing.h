#pragma once

#include <gtest/gtest.h>
#include <mpi.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <string>

#include "seedflow/base/error.h"

namespace seedflow {

/// A new folder, the same on all ranks of a communicator, removed at the end. Without one MPI is not needed.
class TemporaryFolder {
 public:
  explicit TemporaryFolder(MPI_Comm comm_ = MPI_COMM_NULL) : comm(comm_) {
    if (comm != MPI_COMM_NULL) MPI_Comm_rank(comm, &rank);
    char name[64] = "/seedflow_test_XXXXXX";
    std::string full = std::filesystem::temp_directory_path().string() + name;
    if (rank == 0 && ::mkdtemp(full.data()) == nullptr) throw RunError("no temporary folder");
    if (comm != MPI_COMM_NULL) MPI_Bcast(full.data(), static_cast<int>(full.size()), MPI_CHAR, 0, comm);
    path = full;
  }
  ~TemporaryFolder() {
    if (comm != MPI_COMM_NULL) MPI_Barrier(comm);
    std::error_code ignored;
    if (rank == 0) std::filesystem::remove_all(path, ignored);
  }
  std::filesystem::path operator/(const std::string& name) const { return path / name; }
  std::filesystem::path path;

 private:
  MPI_Comm comm;
  int rank = 0;
};

inline void write_text(const std::filesystem::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

/// Files of this process can grow to so many bytes only while this lives: what a full disk looks like to a
/// writer.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) {
    former_handler = std::signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &former);
    const rlimit limit{bytes, former.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    setrlimit(RLIMIT_FSIZE, &former);
    std::signal(SIGXFSZ, former_handler);
  }

 private:
  rlimit former{};
  void (*former_handler)(int);
};

/// The message of the exception of type E that `action` throws; fails the test if it throws none.
template <class E, class Action>
std::string message_of(Action&& action) {
  try {
    action();
  } catch (const E& error) {
    return error.what();
  }
  ADD_FAILURE() << "no exception of the expected type";
  return "";
}

#define EXPECT_CONTAINS(text, part) EXPECT_NE((text).find(part), std::string::npos) << "in: " << (text)

}  // namespace seedflow
