#include "seedflow/seeds/motion.h"
#include "seedflow/seeds/rigid_load.h"

namespace seedflow {
namespace {

struct Axes {
  LaneVec3 x, y, z;  ///< the template's axes in the lab frame
};

Axes axes_of(const LaneQuaternion& q) {
  const LaneVec3 x{broadcast(1.0), Lanes{}, Lanes{}}, y{Lanes{}, broadcast(1.0), Lanes{}},
      z{Lanes{}, Lanes{}, broadcast(1.0)};
  return {rotate(q, x), rotate(q, y), rotate(q, z)};
}

SEEDFLOW_INLINE LaneVec3 along(const Axes& a, const Vec3& r) {
  return r.x * a.x + r.y * a.y + r.z * a.z;
}

LaneVec3 spin_of(const BodyLanes& body, const Axes& a, const Vec3& inertia) {
  const LaneVec3& l = body.angular_momentum;
  return (dot(l, a.x) / inertia.x) * a.x + (dot(l, a.y) / inertia.y) * a.y + (dot(l, a.z) / inertia.z) * a.z;
}

// One factor of the splitting: for the time t the body turns about its own axis c alone, omega_c = L_c / I_c.
void turn_about(LaneQuaternion& q, LaneVec3& momentum, int c, double t, double inertia) {
  Lanes* const l[3] = {&momentum.x, &momentum.y, &momentum.z};
  const Lanes half = (0.5 * t / inertia) * *l[c], y = half * half;
  const Lanes cosine = 1.0 - y * (1.0 / 2 - y * (1.0 / 24 - y * (1.0 / 720 - y * (1.0 / 40320))));
  const Lanes sine = half * (1.0 - y * (1.0 / 6 - y * (1.0 / 120 - y * (1.0 / 5040))));
  LaneQuaternion turn{cosine, {}};
  (c == 0 ? turn.v.x : c == 1 ? turn.v.y : turn.v.z) = sine;
  q = q * turn;
  momentum = rotate_back(turn, momentum);
}

// Free rotation over the time t: the angular momentum in the lab frame stays, the template's axes move
// (Dullweber, Leimkuhler & McLachlan 1997): symplectic, reversible, second order.
LaneQuaternion freely_turned(const BodyLanes& body, const Vec3& inertia, double t) {
  LaneQuaternion q = body.orientation;
  LaneVec3 l = rotate_back(q, body.angular_momentum);
  turn_about(q, l, 0, 0.5 * t, inertia.x);
  turn_about(q, l, 1, 0.5 * t, inertia.y);
  turn_about(q, l, 2, t, inertia.z);
  turn_about(q, l, 1, 0.5 * t, inertia.y);
  turn_about(q, l, 0, 0.5 * t, inertia.x);
  const Lanes n = 1.5 - 0.5 * (q.w * q.w + dot(q.v, q.v));
  return {n * q.w, n * q.v};
}

}  // namespace

void place_spheres(SeedStore& store, int b) {
  const BodyLanes& body = store.body[b];
  const Axes a = axes_of(body.orientation);
  const LaneVec3 spin = spin_of(body, a, store.model.inertia);
  SphereLanes* const spheres = store.block(b);
  for (int i = 0; i < store.n_spheres(); ++i) {
    const LaneVec3 arm = along(a, store.model.position[i]);
    spheres[i].position = body.position + arm;
    spheres[i].velocity = body.velocity + cross(spin, arm);
    spheres[i].angular_velocity = spin;
    spheres[i].orientation = body.orientation;
  }
}

double move_rigid(SeedStore& store, int b, ForceLanes* forces, const MotionStep& step) {
  const SeedTemplate& model = store.model;
  BodyLanes& body = store.body[b];
  SphereLanes* const spheres = store.block(b);
  const Axes a = axes_of(body.orientation);
  LaneVec3 force = (store.occupied[b] * model.mass) * broadcast(step.gravity), torque;
  for (int i = 0; forces && i < store.n_spheres(); ++i) {
    force += forces[i].force;
    torque += forces[i].torque + cross(along(a, model.position[i]), forces[i].force);
    if (step.drift > 0) forces[i] = ForceLanes{};
  }
  if (store.load.empty()) {
    body.velocity += (step.kick / model.mass) * force;
    body.angular_momentum += step.kick * torque;
  } else {
    const Vec3& inertia = model.inertia;
    const LaneVec3 spin = spin_of(body, a, inertia);
    for (int lane = 0; lane < lane_width; ++lane) {
      if (store.occupied[b][lane] == 0.0) continue;
      const Quaternion q = body.orientation.get(lane);
      Vec3 v = body.velocity.get(lane), w = spin.get(lane);
      kick_reduced(store.rigid_load[b * lane_width + lane], q, force.get(lane), torque.get(lane), step.kick,
                   step.half, v, w);
      const Vec3 change = rotate_back(q, w - spin.get(lane));
      body.velocity.set(lane, v);
      body.angular_momentum.add(
          lane, rotate(q, {inertia.x * change.x, inertia.y * change.y, inertia.z * change.z}));
    }
  }
  if (step.drift > 0) {
    body.position += step.drift * body.velocity;
    body.orientation = freely_turned(body, model.inertia, step.drift);
  }
  place_spheres(store, b);
  Lanes fastest = {};
  for (int i = 0; i < store.n_spheres(); ++i)
    fastest = lane_max(fastest, dot(spheres[i].velocity, spheres[i].velocity));
  double result = 0;
  for (int lane = 0; lane < lane_width; ++lane) result = fastest[lane] > result ? fastest[lane] : result;
  return result;
}

}  // namespace seedflow
