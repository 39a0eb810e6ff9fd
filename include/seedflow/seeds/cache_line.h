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

/// Number `component` of records[index[l] * stride] in lane l.
template <int stride>
SEEDFLOW_INLINE Lanes gather(const CacheLine* records, const int* index, int component) {
  const __m256i line = _mm256_mullo_epi32(_mm256_loadu_si256(reinterpret_cast<const __m256i*>(index)),
                                          _mm256_set1_epi32(8 * stride));
  return (Lanes)_mm512_i32gather_pd(line, records->value + component, 8);
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

template <int stride>
SEEDFLOW_INLINE Lanes gather(const CacheLine* records, const int* index, int component) {
  Lanes r;
  for (int l = 0; l < lane_width; ++l) r[l] = records[index[l] * stride].value[component];
  return r;
}

SEEDFLOW_INLINE unsigned mask_bits(LaneMask mask) {
  unsigned bits = 0;
  for (int l = 0; l < lane_width; ++l) bits |= (mask[l] & 1) << l;
  return bits;
}

#endif

}  // namespace seedflow
