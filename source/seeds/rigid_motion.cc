#include "seedflow/seeds/motion.h"
#include "seedflow/seeds/rigid_load.h"

namespace seedflow {
namespace {

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

RigidFrame::RigidFrame(const BodyLanes& body, const Vec3& inertia) {
  const LaneQuaternion& q = body.orientation;
  x = rotate(q, broadcast(Vec3{1, 0, 0})), y = rotate(q, broadcast(Vec3{0, 1, 0})), z = cross(x, y);
  const LaneVec3& l = body.angular_momentum;
  spin = ((1 / inertia.x) * dot(l, x)) * x + ((1 / inertia.y) * dot(l, y)) * y +
         ((1 / inertia.z) * dot(l, z)) * z;
}

void move_rigid(SeedStore& store, int b, const ForceLanes& contacts, const MotionStep& step,
                FastestSpeeds& fastest) {
  const SeedTemplate& model = store.model;
  const Vec3& inertia = model.inertia;
  BodyLanes& body = store.body[b];
  const LaneVec3 force = contacts.force + (store.occupied[b] * model.mass) * broadcast(step.gravity);
  if (store.load.empty()) {
    body.velocity += (step.kick / model.mass) * force;
    body.angular_momentum += step.kick * contacts.torque;
  } else {
    const LaneVec3 spin = RigidFrame(body, inertia).spin;
    for (int lane = 0; lane < lane_width; ++lane) {
      if (store.occupied[b][lane] == 0.0) continue;
      const Quaternion q = body.orientation.get(lane);
      Vec3 v = body.velocity.get(lane), w = spin.get(lane);
      kick_reduced(store.rigid_load[b * lane_width + lane], q, force.get(lane), contacts.torque.get(lane),
                   step.kick, step.half, v, w);
      const Vec3 change = rotate_back(q, w - spin.get(lane));
      body.velocity.set(lane, v);
      body.angular_momentum.add(
          lane, rotate(q, {inertia.x * change.x, inertia.y * change.y, inertia.z * change.z}));
    }
  }
  fastest.velocity = lane_max(fastest.velocity, dot(body.velocity, body.velocity));
  if (step.drift > 0) body.position += step.drift * body.velocity;
  if (model.n_spheres() == 1) {
    // A sphere turns uniformly, whatever the axis.
    if (step.drift > 0)
      body.orientation = turned(body.orientation, (step.drift / inertia.x) * body.angular_momentum);
    return;
  }
  if (step.drift > 0) body.orientation = freely_turned(body, inertia, step.drift);
  // |spin| <= |L| / least moment
  const double arm = model.bounding_radius / inertia.x;
  fastest.turning =
      lane_max(fastest.turning, (arm * arm) * dot(body.angular_momentum, body.angular_momentum));
}

}  // namespace seedflow
