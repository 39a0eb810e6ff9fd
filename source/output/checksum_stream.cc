#include "checksum_stream.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>

#include "seedflow/base/error.h"

namespace seedflow {

std::string Checksum::text() const {
  char digits[17];
  std::snprintf(digits, sizeof digits, "%016llx", static_cast<unsigned long long>(value));
  return digits;
}

Checksum checksum_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw RunError("The checkpoint file '" + file.string() + "' is missing or cannot be read.");
  Checksum sum;
  std::array<char, 1 << 16> block;
  while (in.read(block.data(), block.size()), in.gcount() > 0)
    sum.add(block.data(), static_cast<std::size_t>(in.gcount()));
  if (in.bad()) throw RunError("The checkpoint file '" + file.string() + "' cannot be read to its end.");
  return sum;
}

ChecksumFile::ChecksumFile(const std::filesystem::path& file)
    : handle(::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666)) {
  if (handle < 0) error = errno;
  setp(buffer.data(), buffer.data() + buffer.size());
}

ChecksumFile::~ChecksumFile() {
  if (handle >= 0) ::close(handle);
}

bool ChecksumFile::drain() {
  const char* data = pbase();
  sum.add(data, static_cast<std::size_t>(pptr() - data));
  while (error == 0 && data < pptr()) {
    const ssize_t n = ::write(handle, data, static_cast<std::size_t>(pptr() - data));
    if (n >= 0)
      data += n;
    else if (errno != EINTR)
      error = errno;
  }
  setp(buffer.data(), buffer.data() + buffer.size());
  return error == 0;
}

ChecksumFile::int_type ChecksumFile::overflow(int_type c) {
  if (!drain()) return traits_type::eof();
  if (!traits_type::eq_int_type(c, traits_type::eof())) sputc(traits_type::to_char_type(c));
  return traits_type::not_eof(c);
}

int ChecksumFile::sync() {
  return drain() ? 0 : -1;
}

std::string ChecksumFile::close() {
  if (handle >= 0) {
    drain();
    if (error == 0 && ::fsync(handle) != 0 && errno != EINVAL) error = errno;
    if (::close(handle) != 0 && error == 0) error = errno;
    handle = -1;
  }
  return error == 0 ? "" : std::strerror(error);
}

}  // namespace seedflow
