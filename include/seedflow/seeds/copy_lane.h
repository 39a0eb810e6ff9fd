#pragma once

#include <type_traits>

#include "seedflow/base/lane.h"

namespace seedflow {

/// Copies one lane of n records that consist of Lanes alone into a lane of n others.
template <class Record>
void copy_lane(Record* to, int lane, const Record* from, int old_lane, int n) {
  static_assert(std::is_trivially_copyable_v<Record> && sizeof(Record) % sizeof(Lanes) == 0);
  const int n_rows = n * static_cast<int>(sizeof(Record) / sizeof(Lanes));
  Lanes* const target = reinterpret_cast<Lanes*>(to);
  const Lanes* const source = reinterpret_cast<const Lanes*>(from);
  for (int k = 0; k < n_rows; ++k) target[k][lane] = source[k][old_lane];
}

}  // namespace seedflow
