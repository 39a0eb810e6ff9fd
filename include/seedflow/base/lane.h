#pragma once

/// SIMD lanes of doubles by the compiler's vector extensions (GCC, Clang). The width follows the instruction
/// set the file is compiled for: 8 with AVX-512, 4 with AVX, else 2 (SSE2, NEON). Arithmetic operators,
/// comparisons (giving masks) and mixing with scalars come from the compiler; v[i] reads or writes one lane.

namespace seedflow {

#if defined(__AVX512F__)
inline constexpr int lane_width = 8;
#elif defined(__AVX__)
inline constexpr int lane_width = 4;
#else
inline constexpr int lane_width = 2;
#endif

typedef double Lanes __attribute__((vector_size(lane_width * sizeof(double))));
typedef decltype(Lanes{} > Lanes{}) LaneMask;  ///< -1 true, 0 false

#define SEEDFLOW_INLINE inline __attribute__((always_inline))

SEEDFLOW_INLINE Lanes broadcast(double a) {
  Lanes r;
  for (int i = 0; i < lane_width; ++i) r[i] = a;
  return r;
}

/// mask ? a : b in each lane.
SEEDFLOW_INLINE Lanes select(LaneMask mask, Lanes a, Lanes b) {
  return mask ? a : b;
}
SEEDFLOW_INLINE Lanes lane_max(Lanes a, Lanes b) {
  return a > b ? a : b;
}
SEEDFLOW_INLINE Lanes lane_min(Lanes a, Lanes b) {
  return a < b ? a : b;
}

SEEDFLOW_INLINE Lanes lane_sqrt(Lanes a) {
  Lanes r;
  for (int i = 0; i < lane_width; ++i) r[i] = __builtin_sqrt(a[i]);
  return r;
}
SEEDFLOW_INLINE Lanes lane_cbrt(Lanes a) {
  Lanes r;
  for (int i = 0; i < lane_width; ++i) r[i] = __builtin_cbrt(a[i]);
  return r;
}

// The same for one number, so that a formula can be written once for double and Lanes.
SEEDFLOW_INLINE double select(bool mask, double a, double b) {
  return mask ? a : b;
}
SEEDFLOW_INLINE double lane_max(double a, double b) {
  return a > b ? a : b;
}
SEEDFLOW_INLINE double lane_min(double a, double b) {
  return a < b ? a : b;
}
SEEDFLOW_INLINE double lane_sqrt(double a) {
  return __builtin_sqrt(a);
}
SEEDFLOW_INLINE double lane_cbrt(double a) {
  return __builtin_cbrt(a);
}

SEEDFLOW_INLINE double lane_sum(Lanes a) {
  double s = 0;
  for (int i = 0; i < lane_width; ++i) s += a[i];
  return s;
}

}  // namespace seedflow
