#pragma once

#if defined(__AVX512F__)
#include <immintrin.h>
#endif

#include "seedflow/base/lane.h"

namespace seedflow {

/// A record of eight doubles: one cache line. Not set to zero unless made by CacheLine{}.
struct alignas(64) CacheLine {
  double value[8];

  double& operator[](int i) { return value[i]; }
  double operator[](int i) const { return value[i]; }
};

/// Four doubles: half a cache line.
typedef double HalfRow __attribute__((vector_size(32)));
/// What address(l) points to, as if it were an array of pointers.
template <class Address>
struct RecordsAt {
  Address address;
  SEEDFLOW_INLINE auto operator[](int l) const { return address(l); }
};
template <class Address>
RecordsAt(Address) -> RecordsAt<Address>;

/// Four doubles, not set to zero unless made by HalfLine{}.
struct alignas(32) HalfLine {
  double value[4];

  double& operator[](int i) { return value[i]; }
  double operator[](int i) const { return value[i]; }
  SEEDFLOW_INLINE HalfRow row() const { return *reinterpret_cast<const HalfRow*>(value); }
  SEEDFLOW_INLINE void set(HalfRow row) { *reinterpret_cast<HalfRow*>(value) = row; }
};

#if defined(__AVX512F__)

// GCC 12 takes the don't-care operands inside of its own intrinsics for uninitialised variables.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wuninitialized"

/// Turns eight rows of eight numbers into columns, or back.
SEEDFLOW_INLINE void transpose(Lanes (&row)[8]) {
  __m512d pair[8], quad[8];
  for (int k = 0; k < 8; k += 2) {
    pair[k] = _mm512_unpacklo_pd((__m512d)row[k], (__m512d)row[k + 1]);
    pair[k + 1] = _mm512_unpackhi_pd((__m512d)row[k], (__m512d)row[k + 1]);
  }
  for (int k = 0; k < 8; k += 4)
    for (int j = 0; j < 2; ++j) {
      quad[k + j] = _mm512_shuffle_f64x2(pair[k + j], pair[k + j + 2], 0x88);
      quad[k + j + 2] = _mm512_shuffle_f64x2(pair[k + j], pair[k + j + 2], 0xdd);
    }
  for (int j = 0; j < 4; ++j) {
    row[j] = (Lanes)_mm512_shuffle_f64x2(quad[j], quad[j + 4], 0x88);
    row[j + 4] = (Lanes)_mm512_shuffle_f64x2(quad[j], quad[j + 4], 0xdd);
  }
}

/// column[c] holds number c of every record. from[l] points to a CacheLine; for four columns, to a HalfLine.
template <class Records>
SEEDFLOW_INLINE void load_columns(const Records& from, Lanes (&column)[8]) {
  for (int l = 0; l < 8; ++l) column[l] = *reinterpret_cast<const Lanes*>(from[l]->value);
  transpose(column);
}

/// record[l] = number l of every column.
SEEDFLOW_INLINE void to_records(const Lanes (&column)[8], CacheLine* record) {
  Lanes row[8];
  for (int c = 0; c < 8; ++c) row[c] = column[c];
  transpose(row);
  for (int l = 0; l < 8; ++l) *reinterpret_cast<Lanes*>(record[l].value) = row[l];
}

/// Columns of rows of four.
SEEDFLOW_INLINE void transpose(const __m256d (&row)[8], Lanes (&column)[4]) {
  __m512d two[4];
  for (int k = 0; k < 4; ++k) {
    const int first = (k & 1) + 2 * (k & 2);  // rows 0|2, 1|3, 4|6, 5|7
    two[k] = _mm512_insertf64x4(_mm512_castpd256_pd512(row[first]), row[first + 2], 1);
  }
  const __m512d even_a = _mm512_unpacklo_pd(two[0], two[1]), odd_a = _mm512_unpackhi_pd(two[0], two[1]),
                even_b = _mm512_unpacklo_pd(two[2], two[3]), odd_b = _mm512_unpackhi_pd(two[2], two[3]);
  column[0] = (Lanes)_mm512_shuffle_f64x2(even_a, even_b, 0x88);
  column[1] = (Lanes)_mm512_shuffle_f64x2(odd_a, odd_b, 0x88);
  column[2] = (Lanes)_mm512_shuffle_f64x2(even_a, even_b, 0xdd);
  column[3] = (Lanes)_mm512_shuffle_f64x2(odd_a, odd_b, 0xdd);
}

template <class Records>
SEEDFLOW_INLINE void load_columns(const Records& from, Lanes (&column)[4]) {
  __m256d row[8];
  for (int l = 0; l < 8; ++l) row[l] = _mm256_load_pd(from[l]->value);
  transpose(row, column);
}
SEEDFLOW_INLINE void to_records(const Lanes (&column)[4], HalfLine* record) {
  const __m512d c0 = (__m512d)column[0], c1 = (__m512d)column[1], c2 = (__m512d)column[2],
                c3 = (__m512d)column[3];
  const __m512d even_a = _mm512_unpacklo_pd(c0, c1), odd_a = _mm512_unpackhi_pd(c0, c1),
                even_b = _mm512_unpacklo_pd(c2, c3), odd_b = _mm512_unpackhi_pd(c2, c3);
  const __m512i low = _mm512_setr_epi64(0, 1, 8, 9, 2, 3, 10, 11),
                high = _mm512_setr_epi64(4, 5, 12, 13, 6, 7, 14, 15);
  const __m512d two[4] = {
      _mm512_permutex2var_pd(even_a, low, even_b), _mm512_permutex2var_pd(odd_a, low, odd_b),
      _mm512_permutex2var_pd(even_a, high, even_b), _mm512_permutex2var_pd(odd_a, high, odd_b)};
  for (int k = 0; k < 4; ++k) {  // rows 0|2, 1|3, 4|6, 5|7
    const int first = (k & 1) + 2 * (k & 2);
    _mm256_store_pd(record[first].value, _mm512_castpd512_pd256(two[k]));
    _mm256_store_pd(record[first + 2].value, _mm512_extractf64x4_pd(two[k], 1));
  }
}

/// Of pairs of records: first - second of the numbers 0 to 2, first + second of number 3.
template <class Records>
SEEDFLOW_INLINE void load_differences(const Records& first, const Records& second, Lanes (&column)[4]) {
  const __m256d sign = _mm256_setr_pd(-1, -1, -1, 1);
  __m256d row[8];
  for (int l = 0; l < 8; ++l)
    row[l] = _mm256_fmadd_pd(_mm256_load_pd(second[l]->value), sign, _mm256_load_pd(first[l]->value));
  transpose(row, column);
}

/// One bit per lane.
SEEDFLOW_INLINE unsigned mask_bits(LaneMask mask) {
  return _mm512_movepi64_mask((__m512i)mask);
}

#pragma GCC diagnostic pop

#else

template <class Records>
SEEDFLOW_INLINE void load_columns(const Records& from, Lanes (&column)[8]) {
  for (int l = 0; l < lane_width; ++l)
    for (int c = 0; c < 8; ++c) column[c][l] = from[l]->value[c];
}

template <class Records>
SEEDFLOW_INLINE void load_columns(const Records& from, Lanes (&column)[4]) {
  for (int l = 0; l < lane_width; ++l)
    for (int c = 0; c < 4; ++c) column[c][l] = from[l]->value[c];
}

SEEDFLOW_INLINE void to_records(const Lanes (&column)[4], HalfLine* record) {
  for (int l = 0; l < lane_width; ++l)
    for (int c = 0; c < 4; ++c) record[l].value[c] = column[c][l];
}

SEEDFLOW_INLINE void to_records(const Lanes (&column)[8], CacheLine* record) {
  for (int l = 0; l < lane_width; ++l)
    for (int c = 0; c < 8; ++c) record[l].value[c] = column[c][l];
}

template <class Records>
SEEDFLOW_INLINE void load_differences(const Records& first, const Records& second, Lanes (&column)[4]) {
  for (int l = 0; l < lane_width; ++l) {
    for (int c = 0; c < 3; ++c) column[c][l] = first[l]->value[c] - second[l]->value[c];
    column[3][l] = first[l]->value[3] + second[l]->value[3];
  }
}

SEEDFLOW_INLINE unsigned mask_bits(LaneMask mask) {
  unsigned bits = 0;
  for (int l = 0; l < lane_width; ++l) bits |= (mask[l] & 1) << l;
  return bits;
}

#endif

}  // namespace seedflow
