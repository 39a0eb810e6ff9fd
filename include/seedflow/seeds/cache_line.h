#pragma once

#if defined(__AVX512F__)
#include <immintrin.h>
#endif

#include "seedflow/base/lane.h"

namespace seedflow {

/// A record of eight doubles: one cache line.
struct alignas(64) CacheLine {
  double value[8] = {};

  double& operator[](int i) { return value[i]; }
  double operator[](int i) const { return value[i]; }
};

#if defined(__AVX512F__)

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

/// column[c] holds number c of every record.
SEEDFLOW_INLINE void load_columns(const CacheLine* const (&from)[lane_width], Lanes (&column)[8]) {
  for (int l = 0; l < 8; ++l) column[l] = *reinterpret_cast<const Lanes*>(from[l]->value);
  transpose(column);
}

/// record[l] = number l of every column.
SEEDFLOW_INLINE void to_records(const Lanes (&column)[8], CacheLine (&record)[lane_width]) {
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

/// Of pairs of records: first - second of the numbers 0 to 2, first + second of number 3.
SEEDFLOW_INLINE void load_differences(const CacheLine* const (&first)[lane_width],
                                      const CacheLine* const (&second)[lane_width], Lanes (&column)[4]) {
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

#else

SEEDFLOW_INLINE void load_columns(const CacheLine* const (&from)[lane_width], Lanes (&column)[8]) {
  for (int l = 0; l < lane_width; ++l)
    for (int c = 0; c < 8; ++c) column[c][l] = from[l]->value[c];
}

SEEDFLOW_INLINE void to_records(const Lanes (&column)[8], CacheLine (&record)[lane_width]) {
  for (int l = 0; l < lane_width; ++l)
    for (int c = 0; c < 8; ++c) record[l].value[c] = column[c][l];
}

SEEDFLOW_INLINE void load_differences(const CacheLine* const (&first)[lane_width],
                                      const CacheLine* const (&second)[lane_width], Lanes (&column)[4]) {
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
