#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <streambuf>
#include <string>

namespace seedflow {

/// FNV-1a, 64 bits: enough to notice damage by accident (Fowler, Noll, Vo; RFC 9923).
class Checksum {
 public:
  void add(const char* data, std::size_t size) {
    for (std::size_t i = 0; i < size; ++i)
      value = (value ^ static_cast<unsigned char>(data[i])) * 0x100000001b3ull;
    count += size;
  }
  std::string text() const;  ///< 16 hexadecimal digits
  std::uint64_t bytes() const { return count; }

 private:
  std::uint64_t value = 0xcbf29ce484222325ull, count = 0;
};

/// Of a whole file. Errors: RunError.
Checksum checksum_of(const std::filesystem::path& file);

/// A stream buffer that writes into a file and keeps the checksum of what went through.
class ChecksumFile : public std::streambuf {
 public:
  explicit ChecksumFile(const std::filesystem::path& file);
  ~ChecksumFile() override;
  /// Empties the buffer, synchronises to disk and closes. "" or the system's reason for the first failure.
  std::string close();
  const Checksum& checksum() const { return sum; }

 protected:
  int_type overflow(int_type c) override;
  int sync() override;

 private:
  bool drain();
  int handle = -1;
  int error = 0;
  Checksum sum;
  std::array<char, 1 << 16> buffer;
};

}  // namespace seedflow
