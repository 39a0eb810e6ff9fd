#pragma once

#include "seedflow/base/vector.h"

namespace seedflow {

/// A unit quaternion (w, v): the rotation that carries a body's reference frame into the lab frame.
struct Quaternion {
  double w = 1;
  Vec3 v;
};

inline Quaternion operator*(const Quaternion& a, const Quaternion& b) {
  return {a.w * b.w - dot(a.v, b.v), a.w * b.v + b.w * a.v + cross(a.v, b.v)};
}
inline Quaternion conjugate(const Quaternion& q) { return {q.w, -q.v}; }

inline Quaternion normalized(const Quaternion& q) {
  const double s = 1.0 / std::sqrt(q.w * q.w + norm_square(q.v));
  return {q.w * s, q.v * s};
}

/// The vector a, given in the body frame, in the lab frame.
inline Vec3 rotate(const Quaternion& q, const Vec3& a) {
  const Vec3 t = 2.0 * cross(q.v, a);
  return a + q.w * t + cross(q.v, t);
}
inline Vec3 rotate_back(const Quaternion& q, const Vec3& a) { return rotate(conjugate(q), a); }

/// The exact rotation by the vector `angle` (rad, axis times angle).
inline Quaternion rotation(const Vec3& angle) {
  const double a = norm(angle), half = 0.5 * a;
  const double s = a > 1e-8 ? std::sin(half) / a : 0.5 - a * a / 48.0;
  return {std::cos(half), s * angle};
}

}  // namespace seedflow
