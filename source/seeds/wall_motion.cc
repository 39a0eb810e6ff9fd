#include "seedflow/seeds/wall_motion.h"

#include <algorithm>
#include <cmath>

#include "seedflow/base/error.h"

namespace seedflow {

TimeLaw::Value TimeLaw::at(double time) const {
  if (time < start) return {};
  const bool over = time >= stop;
  const double t = std::min(time, stop) - start;
  Value v;
  switch (kind) {
    case Kind::rest:
      break;
    case Kind::constant:
      v = {speed * t, speed};
      break;
    case Kind::ramp:
      v = t < duration ? Value{0.5 * speed * t * t / duration, speed * t / duration}
                       : Value{speed * (t - 0.5 * duration), speed};
      break;
    case Kind::sinusoid: {
      const double w = 2 * M_PI * frequency;
      v = {amplitude * (std::sin(w * t + phase) - std::sin(phase)), amplitude * w * std::cos(w * t + phase)};
      break;
    }
    case Kind::expression:
      v = {expression->value(t), over ? 0 : expression->rate(t)};
      break;
  }
  if (over) v.rate = 0;
  return v;
}

namespace {
void make_unit(Vec3& direction, const TimeLaw& law, const std::string& name, const std::string& what) {
  if (law.kind == TimeLaw::Kind::rest) return;
  const double size = norm(direction);
  if (!(size > 0) || !std::isfinite(size))
    throw InputError("Wall '" + name + "': " + what + " is zero, but the wall moves. Give a direction.");
  direction /= size;
  if (law.kind == TimeLaw::Kind::ramp && !(law.duration > 0))
    throw InputError("Wall '" + name + "': a ramp needs a duration above 0 s.");
  if (law.kind == TimeLaw::Kind::expression) {
    if (!law.expression) throw InputError("Wall '" + name + "': " + what + " has no expression in time.");
    const double at_start = law.expression->value(0);
    if (std::abs(at_start) > 1e-12)
      throw InputError("Wall '" + name + "': the expression \"" + law.expression->text() + "\" is " +
                       std::to_string(at_start) +
                       " at t = 0, so the wall would jump. Make it 0 there; t counts from the start of the "
                       "motion.");
  }
  if (!(law.stop >= law.start))
    throw InputError("Wall '" + name + "': the motion stops at " + std::to_string(law.stop) +
                     " s, before it starts at " + std::to_string(law.start) + " s.");
}
}  // namespace

void WallMotion::check(const std::string& name) {
  make_unit(direction, displacement, name, "the direction of the motion");
  make_unit(axis, angle, name, "the axis of rotation");
}

WallMotion WallMotion::constant(const Vec3& velocity) {
  WallMotion m;
  if (norm(velocity) > 0) {
    m.direction = velocity / norm(velocity);
    m.displacement.kind = TimeLaw::Kind::constant;
    m.displacement.speed = norm(velocity);
  }
  return m;
}

WallMotion WallMotion::rotation(const Vec3& pivot, const Vec3& angular_velocity) {
  WallMotion m;
  m.pivot = pivot;
  if (norm(angular_velocity) > 0) {
    m.axis = angular_velocity / norm(angular_velocity);
    m.angle.kind = TimeLaw::Kind::constant;
    m.angle.speed = norm(angular_velocity);
  }
  return m;
}

Placement placement(const WallMotion& m, double time) {
  const TimeLaw::Value s = m.displacement.at(time), angle = m.angle.at(time);
  Placement p;
  p.turn = rotation(angle.value * m.axis);
  p.pivot = m.pivot;
  p.shift = s.value * m.direction;
  p.velocity = s.rate * m.direction;
  p.spin = angle.rate * m.axis;
  return p;
}

}  // namespace seedflow
