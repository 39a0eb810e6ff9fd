#pragma once

#include <cstdint>

namespace seedflow {

/// term(begin) + ... + term(end - 1) in four interleaved partial sums: in one alone every addition would wait
/// for the one before, which for rows of 27 entries takes longer than fetching them.
template <class Sum, class Term>
inline Sum row_sum(std::uint32_t begin, std::uint32_t end, const Term& term) {
  Sum part[4] = {};
  std::uint32_t k = begin;
  for (; k + 4 <= end; k += 4)
    for (int i = 0; i < 4; ++i) part[i] += term(k + i);
  for (; k < end; ++k) part[0] += term(k);
  return (part[0] + part[1]) + (part[2] + part[3]);
}

}  // namespace seedflow
