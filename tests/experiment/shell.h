#pragma once

#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

namespace seedflow {

/// What a command left behind.
struct ShellResult {
  int status = -1;
  std::string out, err;
};

/// Runs a shell command in `folder` as from a fresh shell: the test itself is an MPI process, and what MPI
/// leaves in the environment would be inherited otherwise.
inline ShellResult run_in_shell(const std::string& command, const std::filesystem::path& folder) {
  const auto text_of = [](const std::filesystem::path& file) {
    std::ifstream in(file);
    return std::string((std::istreambuf_iterator<char>(in)), {});
  };
  const std::filesystem::path out = folder / "stdout.txt", err = folder / "stderr.txt";
  const std::string line =
      "cd '" + folder.string() +
      "' && env -i PATH=\"$PATH\" HOME=\"${HOME:-/}\" OMP_NUM_THREADS=1 DEAL_II_NUM_THREADS=1 " + command +
      " >'" + out.string() + "' 2>'" + err.string() + "'";
  const int raw = std::system(line.c_str());
  return {WIFEXITED(raw) ? WEXITSTATUS(raw) : 128 + WTERMSIG(raw), text_of(out), text_of(err)};
}

}  // namespace seedflow
