#include "seedflow/seeds/motion.h"

#include <algorithm>
#include <cmath>

namespace seedflow {
namespace {

// The kick m dv/dt = F + k (u - v), F held, has the solution m dv = h F + J with the drag's impulse
// J = h (phi k (u - v) + (phi - 1) F), phi = (1 - exp(-z))/z, z = k h/m. Writing dv through J makes the
// bookkeeping exact; an added mass joins the inertia of the kick and its share of m dv is booked as an
// impulse, too.
SEEDFLOW_INLINE void kick_loaded(SphereLanes& s, const ForceLanes& f, LoadLanes& l, const LaneVec3& weight,
                                 double mass, const MotionStep& step) {
  const Lanes phi = step.half ? l.relaxed_half : l.relaxed_full;
  const LaneVec3 force = f.force + l.force + weight;
  const LaneVec3 drag_impulse = step.kick * ((phi * l.drag) * (l.flow - s.velocity) + (phi - 1.0) * force);
  const LaneVec3 dv = (1.0 / (mass + l.added_mass)) * (step.kick * force + drag_impulse);
  s.velocity += dv;
  l.impulse += drag_impulse - l.added_mass * dv;
}

template <bool loaded>
void move(SphereLanes* spheres, ForceLanes* forces, LoadLanes* loads, Lanes occupied,
          const SeedTemplate& model, const MotionStep& step, FastestSpeeds& speeds) {
  const LaneVec3 gravity{step.gravity.x * occupied, step.gravity.y * occupied, step.gravity.z * occupied};
  Lanes fastest = speeds.velocity;
  const int n = model.n_spheres();
  for (int i = 0; i < n; ++i) {
    SphereLanes& s = spheres[i];
    ForceLanes& f = forces[i];
    const double mass = model.sphere_mass[i], turning = step.kick / model.sphere_inertia[i];
    if constexpr (loaded) {
      kick_loaded(s, f, loads[i], mass * gravity, mass, step);
      s.angular_velocity += turning * (f.torque + loads[i].torque);
    } else {
      s.velocity += (step.kick / mass) * f.force + step.kick * gravity;
      s.angular_velocity += turning * f.torque;
    }
    if (step.drift > 0) {
      s.position += step.drift * s.velocity;
      s.orientation = turned(s.orientation, step.drift * s.angular_velocity);
      f = ForceLanes{};
    }
    fastest = lane_max(fastest, dot(s.velocity, s.velocity));
  }
  speeds.velocity = fastest;
}

}  // namespace

void move_bonded(SeedStore& store, int b, ForceLanes* forces, const MotionStep& step,
                 FastestSpeeds& fastest) {
  LoadLanes* loads = store.loads(b);
  if (loads)
    move<true>(store.block(b), forces, loads, store.occupied[b], store.model, step, fastest);
  else
    move<false>(store.block(b), forces, nullptr, store.occupied[b], store.model, step, fastest);
}

double FastestSpeeds::bound() const {
  double v = 0, w = 0;
  for (int lane = 0; lane < lane_width; ++lane)
    v = std::max(v, velocity[lane]), w = std::max(w, turning[lane]);
  return std::sqrt(v) + std::sqrt(w);
}

}  // namespace seedflow
