#pragma once

#include <memory>
#include <string>

#include "seedflow/base/quaternion.h"
#include "seedflow/seeds/time_expression.h"

namespace seedflow {

/// A law in time of a displacement [m] or an angle [rad]; s(t) = 0 before `start`, then with t' = t - start:
///   rest        0
///   constant    speed t'
///   ramp        speed t'^2 / (2 duration) up to t' = duration, then at constant speed
///   sinusoid    amplitude (sin(2 pi frequency t' + phase) - sin(phase))
///   expression  a function of t' given as text, 0 at t' = 0
/// After `stop` it keeps its value.
struct TimeLaw {
  enum class Kind { rest, constant, ramp, sinusoid, expression };

  Kind kind = Kind::rest;
  double speed = 0;                                ///< [m/s] or [rad/s]
  double duration = 0;                             ///< of the ramp [s]
  double amplitude = 0, frequency = 0, phase = 0;  ///< [m] or [rad], [1/s], [rad]
  std::shared_ptr<const TimeExpression> expression;
  double start = 0;     ///< [s]
  double stop = 1e300;  ///< [s]

  struct Value {
    double value = 0, rate = 0;  ///< s and ds/dt
  };
  Value at(double time) const;
};

/// How a wall moves: its points turn about an axis and are then displaced,
///   x(t) = pivot + R(axis, angle(t)) (x(0) - pivot) + direction displacement(t).
/// A function of time alone: a restart needs no state.
struct WallMotion {
  Vec3 direction{0, 0, 1};  ///< unit vector after check()
  TimeLaw displacement;
  Vec3 axis{0, 0, 1};  ///< unit vector after check()
  Vec3 pivot;          ///< a point of the axis [m]
  TimeLaw angle;

  /// InputError if a law that is in use lacks its direction or has impossible numbers.
  void check(const std::string& name);
  static WallMotion constant(const Vec3& velocity);
  static WallMotion rotation(const Vec3& pivot, const Vec3& angular_velocity);
};

/// Where a wall is at one instant and how fast it moves.
struct Placement {
  Quaternion turn;
  Vec3 pivot, shift;    ///< [m]
  Vec3 velocity, spin;  ///< [m/s], [rad/s]

  Vec3 to_wall(const Vec3& x) const { return pivot + rotate_back(turn, x - shift - pivot); }
  Vec3 to_lab(const Vec3& x) const { return pivot + rotate(turn, x - pivot) + shift; }
  /// Velocity of the wall's material at a point of the lab frame, v = velocity + spin x (x - pivot - shift).
  Vec3 velocity_at(const Vec3& x) const { return velocity + cross(spin, x - pivot - shift); }
};

Placement placement(const WallMotion& motion, double time);

}  // namespace seedflow
