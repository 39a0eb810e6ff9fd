#pragma once

#include <utility>

#include "seedflow/seeds/cache_line.h"
#include "seedflow/seeds/lane_root.h"

namespace seedflow {

/// Two registers of lanes that do the same. A chain of dependent operations leaves most of a core idle; two
/// such chains side by side fill it.
struct LanePair {
  Lanes a = {}, b = {};
};
struct LanePairMask {
  LaneMask a, b;
};

SEEDFLOW_INLINE LanePair operator+(const LanePair& x, const LanePair& y) {
  return {x.a + y.a, x.b + y.b};
}
SEEDFLOW_INLINE LanePair operator-(const LanePair& x, const LanePair& y) {
  return {x.a - y.a, x.b - y.b};
}
SEEDFLOW_INLINE LanePair operator*(const LanePair& x, const LanePair& y) {
  return {x.a * y.a, x.b * y.b};
}
SEEDFLOW_INLINE LanePair operator/(const LanePair& x, const LanePair& y) {
  return {x.a / y.a, x.b / y.b};
}
SEEDFLOW_INLINE LanePair operator-(const LanePair& x) {
  return {-x.a, -x.b};
}
SEEDFLOW_INLINE LanePair operator+(const LanePair& x, double y) {
  return {x.a + y, x.b + y};
}
SEEDFLOW_INLINE LanePair operator+(double x, const LanePair& y) {
  return {x + y.a, x + y.b};
}
SEEDFLOW_INLINE LanePair operator-(const LanePair& x, double y) {
  return {x.a - y, x.b - y};
}
SEEDFLOW_INLINE LanePair operator-(double x, const LanePair& y) {
  return {x - y.a, x - y.b};
}
SEEDFLOW_INLINE LanePair operator*(const LanePair& x, double y) {
  return {x.a * y, x.b * y};
}
SEEDFLOW_INLINE LanePair operator*(double x, const LanePair& y) {
  return {x * y.a, x * y.b};
}
SEEDFLOW_INLINE LanePair operator/(const LanePair& x, double y) {
  return {x.a / y, x.b / y};
}
SEEDFLOW_INLINE LanePair operator/(double x, const LanePair& y) {
  return {x / y.a, x / y.b};
}
SEEDFLOW_INLINE LanePair& operator+=(LanePair& x, const LanePair& y) {
  return x.a += y.a, x.b += y.b, x;
}
SEEDFLOW_INLINE LanePair& operator*=(LanePair& x, const LanePair& y) {
  return x.a *= y.a, x.b *= y.b, x;
}
SEEDFLOW_INLINE LanePairMask operator>(const LanePair& x, const LanePair& y) {
  return {x.a > y.a, x.b > y.b};
}
SEEDFLOW_INLINE LanePairMask operator<(const LanePair& x, const LanePair& y) {
  return {x.a < y.a, x.b < y.b};
}
SEEDFLOW_INLINE LanePairMask operator==(const LanePair& x, const LanePair& y) {
  return {x.a == y.a, x.b == y.b};
}
SEEDFLOW_INLINE LanePairMask operator>(const LanePair& x, double y) {
  return {x.a > y, x.b > y};
}
SEEDFLOW_INLINE LanePairMask operator==(const LanePairMask& x, const LanePairMask& y) {
  return {x.a == y.a, x.b == y.b};
}

SEEDFLOW_INLINE LanePair select(const LanePairMask& mask, const LanePair& x, const LanePair& y) {
  return {select(mask.a, x.a, y.a), select(mask.b, x.b, y.b)};
}
SEEDFLOW_INLINE LanePair lane_max(const LanePair& x, const LanePair& y) {
  return {lane_max(x.a, y.a), lane_max(x.b, y.b)};
}
SEEDFLOW_INLINE LanePair lane_min(const LanePair& x, const LanePair& y) {
  return {lane_min(x.a, y.a), lane_min(x.b, y.b)};
}
SEEDFLOW_INLINE LanePair lane_sqrt(const LanePair& x) {
  return {lane_sqrt(x.a), lane_sqrt(x.b)};
}
SEEDFLOW_INLINE LanePair lane_cbrt(const LanePair& x) {
  return {lane_cbrt(x.a), lane_cbrt(x.b)};
}
SEEDFLOW_INLINE LanePair inverse(const LanePair& x) {
  return {inverse(x.a), inverse(x.b)};
}
SEEDFLOW_INLINE LanePair inverse_root(const LanePair& x) {
  return {inverse_root(x.a), inverse_root(x.b)};
}

/// How many numbers one Real holds.
template <class Real>
inline constexpr int width_of = sizeof(Real) / sizeof(double);

// Pairs are taken apart and put together one by one: copied whole or in a loop they would go through memory.

namespace lane_pair_detail {
template <int n, std::size_t... c>
SEEDFLOW_INLINE void join(const Lanes (&a)[n], const Lanes (&b)[n], LanePair (&column)[n],
                          std::index_sequence<c...>) {
  ((column[c].a = a[c], column[c].b = b[c]), ...);
}
}  // namespace lane_pair_detail

/// As for Lanes, of twice as many records.
template <class Records, int n>
SEEDFLOW_INLINE void load_columns(const Records& from, LanePair (&column)[n]) {
  Lanes a[n], b[n];
  load_columns(from, a);
  load_columns(RecordsAt{[&](int l) { return from[l + lane_width]; }}, b);
  lane_pair_detail::join(a, b, column, std::make_index_sequence<n>());
}

/// record[l] = number l of each column.
template <class Record, class... Columns>
SEEDFLOW_INLINE void store_records(Record* record, const Lanes& first, const Columns&... column) {
  const Lanes c[] = {first, column...};
  to_records(c, record);
}
template <class Record, class... Columns>
SEEDFLOW_INLINE void store_records(Record* record, const LanePair& first, const Columns&... column) {
  const Lanes a[] = {first.a, column.a...}, b[] = {first.b, column.b...};
  to_records(a, record);
  to_records(b, record + lane_width);
}

}  // namespace seedflow
