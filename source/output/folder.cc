#include "seedflow/output/folder.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>

#include "seedflow/base/error.h"

namespace seedflow {

namespace {

std::string reason(int error_number) {
  return std::strerror(error_number);
}

/// Writes and synchronises; returns 0 or the system's error number.
int write_synchronised(const std::filesystem::path& file, const std::string& content) {
  const int handle = ::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (handle < 0) return errno;
  int error = 0;
  for (std::size_t done = 0; done < content.size();) {
    const ssize_t n = ::write(handle, content.data() + done, content.size() - done);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) {
      error = errno;
      break;
    }
    done += static_cast<std::size_t>(n);
  }
  // Some file systems cannot synchronise (EINVAL); that is no reason to stop.
  if (error == 0 && ::fsync(handle) != 0 && errno != EINVAL) error = errno;
  if (::close(handle) != 0 && error == 0) error = errno;
  return error;
}

}  // namespace

void write_file_atomically(const std::filesystem::path& file, const std::string& content) {
  // The process number keeps two programs that write the same file from sharing a temporary one.
  const std::filesystem::path temporary = file.string() + ".tmp" + std::to_string(::getpid());
  int error = write_synchronised(temporary, content);
  if (error == 0 && ::rename(temporary.c_str(), file.c_str()) != 0) error = errno;
  if (error == 0) return;
  ::unlink(temporary.c_str());
  throw RunError("Cannot write '" + file.string() + "' (" + std::to_string(content.size()) +
                 " bytes): " + reason(error) + ". Free some space or choose another output folder.");
}

void prepare_output_folder(const std::filesystem::path& folder) {
  const std::string remedy = " Choose another folder with --output.";
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (!std::filesystem::is_directory(folder))
    throw InputError("The output folder '" + folder.string() + "' cannot be created: " +
                     (error ? error.message() : std::string("there is a file of that name")) + "." + remedy);
  const std::filesystem::path probe = folder / (".probe" + std::to_string(::getpid()));
  // Some bytes are needed: an empty file can be made on a full disk.
  const int failed = write_synchronised(probe, std::string(4096, ' '));
  ::unlink(probe.c_str());
  if (failed != 0)
    throw InputError("The output folder '" + folder.string() + "' cannot be written: " + reason(failed) +
                     "." + remedy);
}

std::string read_file(const std::filesystem::path& file) {
  std::error_code ignored;
  std::ifstream in(file, std::ios::binary);
  if (!in || std::filesystem::is_directory(file, ignored))
    throw InputError(
        "Cannot read '" + file.string() +
        "': " + (std::filesystem::exists(file, ignored) ? "not a readable file." : "there is no such file."));
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

}  // namespace seedflow
