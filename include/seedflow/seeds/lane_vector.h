#pragma once

#include "seedflow/base/lane.h"
#include "seedflow/base/quaternion.h"
#include "seedflow/base/vector.h"

namespace seedflow {

/// One three-component vector per lane. Real: Lanes, where a lane is a seed or a contact, or LanePair.
template <class Real>
struct VectorLanes {
  Real x = {}, y = {}, z = {};

  void set(int lane, const Vec3& a) { x[lane] = a.x, y[lane] = a.y, z[lane] = a.z; }
  void add(int lane, const Vec3& a) { x[lane] += a.x, y[lane] += a.y, z[lane] += a.z; }
  Vec3 get(int lane) const { return {x[lane], y[lane], z[lane]}; }
};
using LaneVec3 = VectorLanes<Lanes>;

/// The vector made of numbers of type Real: Vec3 for double, else VectorLanes.
template <class Real>
struct VectorOfReal {
  using type = VectorLanes<Real>;
};
template <>
struct VectorOfReal<double> {
  using type = Vec3;
};
template <class Real>
using VectorOf = typename VectorOfReal<Real>::type;

/// One unit quaternion per lane.
struct LaneQuaternion {
  Lanes w = Lanes{} + 1.0;
  LaneVec3 v;

  void set(int lane, const Quaternion& q) { w[lane] = q.w, v.set(lane, q.v); }
  Quaternion get(int lane) const { return {w[lane], v.get(lane)}; }
};

template <class Real>
SEEDFLOW_INLINE VectorLanes<Real> operator+(const VectorLanes<Real>& a, const VectorLanes<Real>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class Real>
SEEDFLOW_INLINE VectorLanes<Real> operator-(const VectorLanes<Real>& a, const VectorLanes<Real>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class Real>
SEEDFLOW_INLINE VectorLanes<Real> operator-(const VectorLanes<Real>& a) {
  return {-a.x, -a.y, -a.z};
}
template <class Real>
SEEDFLOW_INLINE VectorLanes<Real> operator*(const Real& s, const VectorLanes<Real>& a) {
  return {s * a.x, s * a.y, s * a.z};
}
template <class Real>
SEEDFLOW_INLINE VectorLanes<Real> operator*(double s, const VectorLanes<Real>& a) {
  return {s * a.x, s * a.y, s * a.z};
}
template <class Real>
SEEDFLOW_INLINE VectorLanes<Real>& operator+=(VectorLanes<Real>& a, const VectorLanes<Real>& b) {
  return a.x += b.x, a.y += b.y, a.z += b.z, a;
}
template <class Real>
SEEDFLOW_INLINE VectorLanes<Real>& operator-=(VectorLanes<Real>& a, const VectorLanes<Real>& b) {
  return a.x -= b.x, a.y -= b.y, a.z -= b.z, a;
}
template <class Real>
SEEDFLOW_INLINE Real dot(const VectorLanes<Real>& a, const VectorLanes<Real>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class Real>
SEEDFLOW_INLINE VectorLanes<Real> cross(const VectorLanes<Real>& a, const VectorLanes<Real>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class Real>
SEEDFLOW_INLINE Real norm(const VectorLanes<Real>& a) {
  return lane_sqrt(dot(a, a));
}
SEEDFLOW_INLINE LaneVec3 broadcast(const Vec3& a) {
  return {broadcast(a.x), broadcast(a.y), broadcast(a.z)};
}

SEEDFLOW_INLINE LaneQuaternion operator*(const LaneQuaternion& a, const LaneQuaternion& b) {
  return {a.w * b.w - dot(a.v, b.v), a.w * b.v + b.w * a.v + cross(a.v, b.v)};
}

/// The same body-frame vector carried into the lab frame of every lane: a + 2 w (v x a) + 2 v x (v x a).
SEEDFLOW_INLINE LaneVec3 rotate(const LaneQuaternion& q, const LaneVec3& a) {
  const LaneVec3 t = 2.0 * cross(q.v, a);
  return a + q.w * t + cross(q.v, t);
}
/// rotate(q, whole / 2), given both, in fewer operations.
SEEDFLOW_INLINE LaneVec3 rotate_half(const LaneQuaternion& q, const LaneVec3& half, const LaneVec3& whole) {
  const LaneVec3 t = cross(q.v, whole);
  return half + q.w * t + cross(q.v, t);
}
SEEDFLOW_INLINE LaneVec3 rotate_back(const LaneQuaternion& q, const LaneVec3& a) {
  const LaneVec3 t = 2.0 * cross(a, q.v);
  return a + q.w * t + cross(t, q.v);
}

/// q turned by the small rotation vector `angle` (lab frame, rad). Sine and cosine of the half angle by their
/// series up to the eighth order: exact to 1e-16 for |angle| < 0.05; then one Newton step to unit length.
SEEDFLOW_INLINE LaneQuaternion turned(const LaneQuaternion& q, const LaneVec3& angle) {
  const LaneVec3 half = 0.5 * angle;
  const Lanes y = dot(half, half);
  const Lanes c = 1.0 - y * (1.0 / 2 - y * (1.0 / 24 - y * (1.0 / 720 - y * (1.0 / 40320))));
  const Lanes s = 1.0 - y * (1.0 / 6 - y * (1.0 / 120 - y * (1.0 / 5040)));
  LaneQuaternion r = LaneQuaternion{c, s * half} * q;
  const Lanes n = 1.5 - 0.5 * (r.w * r.w + dot(r.v, r.v));
  return {n * r.w, n * r.v};
}

}  // namespace seedflow
