#pragma once

#include <cstdint>
#include <istream>
#include <ostream>
#include <type_traits>
#include <vector>

#include "seedflow/base/error.h"

namespace seedflow {

/// A saved state is not laid out as this program expects: cut off, damaged, or of another version.
class StateFormatError : public RunError {
 public:
  using RunError::RunError;
};

/// Plain values to and from a binary stream, bit by bit, for checkpoints read by the same build.
/// Errors: StateFormatError when the stream ends early or a size does not fit.
template <class T>
void write_binary(std::ostream& out, const T& value) {
  static_assert(std::is_trivially_copyable_v<T>);
  out.write(reinterpret_cast<const char*>(&value), sizeof(T));
}

template <class T>
void read_binary(std::istream& in, T& value) {
  static_assert(std::is_trivially_copyable_v<T>);
  if (!in.read(reinterpret_cast<char*>(&value), sizeof(T)))
    throw StateFormatError(
        "The saved state ends too early: it is damaged or was cut off. Start again without it.");
}

template <class T>
void write_binary(std::ostream& out, const std::vector<T>& values) {
  static_assert(std::is_trivially_copyable_v<T>);
  write_binary(out, static_cast<std::uint64_t>(values.size()));
  out.write(reinterpret_cast<const char*>(values.data()),
            static_cast<std::streamsize>(values.size() * sizeof(T)));
}

template <class T>
void read_binary(std::istream& in, std::vector<T>& values) {
  std::uint64_t n = 0;
  read_binary(in, n);
  if (n > (std::uint64_t(1) << 40) / sizeof(T))
    throw StateFormatError(
        "The saved state is damaged: an array of impossible length. Start again without it.");
  values.resize(n);
  if (n > 0 && !in.read(reinterpret_cast<char*>(values.data()), static_cast<std::streamsize>(n * sizeof(T))))
    throw StateFormatError(
        "The saved state ends too early: it is damaged or was cut off. Start again without it.");
}

}  // namespace seedflow
