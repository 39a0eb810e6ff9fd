#pragma once

#include <algorithm>
#include <vector>

#include "seedflow/seeds/cache_line.h"

namespace seedflow {

/// What contacts remember, in lines that are taken and released as contacts begin and end. A line is eight
/// numbers: tangential spring [m] in 0 to 2, normal force at the last substep [N] in 3, rolling angle [rad]
/// in 4 to 6, whether a cohesive contact holds (1 or 0) or the mark of partial slip in 7. The second half is
/// kept only where a law needs it; else it is zero.
class ContactMemoryPool {
 public:
  /// Forgets everything. Room for so many contacts, and a few more.
  void reset(bool with_second_half, std::size_t contacts) {
    whole = with_second_half;
    std::vector<HalfLine>().swap(first_half), std::vector<HalfLine>().swap(second_half);
    free.clear();
    first_half.reserve(contacts + contacts / 8);
    if (whole) second_half.reserve(contacts + contacts / 8);
  }
  int take() {
    if (!free.empty()) {
      const int line = free.back();
      free.pop_back();
      return line;
    }
    first_half.emplace_back();
    if (whole) second_half.emplace_back();
    return static_cast<int>(first_half.size()) - 1;
  }
  void release(int line) {
    first_half[line] = HalfLine{};
    if (whole) second_half[line] = HalfLine{};
    free.push_back(line);
  }
  bool has_second_half() const { return whole; }
  HalfLine* first(int line) { return &first_half[line]; }
  HalfLine* second(int line) { return &second_half[line]; }

  void write(int line, const double (&memory)[8]) {
    std::copy_n(memory, 4, first_half[line].value);
    if (whole) std::copy_n(memory + 4, 4, second_half[line].value);
  }
  void read(int line, double (&memory)[8]) const {
    std::copy_n(first_half[line].value, 4, memory);
    if (whole)
      std::copy_n(second_half[line].value, 4, memory + 4);
    else
      std::fill_n(memory + 4, 4, 0.0);
  }
  std::size_t bytes() const {
    return (first_half.capacity() + second_half.capacity()) * sizeof(HalfLine) +
           free.capacity() * sizeof(int);
  }

 private:
  std::vector<HalfLine> first_half, second_half;
  std::vector<int> free;
  bool whole = false;
};

}  // namespace seedflow
