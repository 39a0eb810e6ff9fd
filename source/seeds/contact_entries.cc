// From the stores' lanes to the records of the contacts and back.

#include "seedflow/seeds/contacts.h"
#include "seedflow/seeds/motion.h"

namespace seedflow {

void Contacts::take_forces(int block, ForceLanes* forces) {
  for (int e = first_entry[block]; e < first_entry[block + 1]; ++e) {
    ContactSum& sum = all_bodies.sum[all_bodies.body[e]];
    ForceLanes& f = forces[places[e].sphere];
    f.force.add(places[e].lane, {sum[0], sum[1], sum[2]});
    f.torque.add(places[e].lane, {sum[4], sum[5], sum[6]});
    sum = ContactSum{};
  }
}

void Contacts::take_forces(int block, ForceLanes& on_seeds) {
  const int begin = first_entry[block], end = first_entry[block + 1];
  if (begin == end) return;
  const CacheLine zero;
  const CacheLine* row[lane_width];
  for (const CacheLine*& r : row) r = &zero;
  for (int e = begin; e < end; ++e) row[places[e].lane] = &all_bodies.sum[all_bodies.body[e]];
  Lanes c[8];
  load_columns(row, c);
  on_seeds.force += LaneVec3{c[0], c[1], c[2]};
  on_seeds.torque += LaneVec3{c[4], c[5], c[6]};
  for (int body = all_bodies.body[begin]; body <= all_bodies.body[end - 1]; ++body)
    all_bodies.sum[body] = ContactSum{};
}

void Contacts::place(int block, const SeedStore& store, int b) {
  if (store.rigid)
    return store.n_spheres() == 1 ? place_plain_spheres(block, store, b) : place_rigid(block, store, b);
  const SphereLanes* const spheres = store.block(b);
  for (int e = first_entry[block]; e < first_entry[block + 1]; ++e) {
    const SphereLanes& s = spheres[places[e].sphere];
    const int lane = places[e].lane;
    all_bodies.state[e].place(s.position.get(lane), s.velocity.get(lane), s.angular_velocity.get(lane), {});
  }
}

void Contacts::place_plain_spheres(int block, const SeedStore& store, int b) {
  if (first_entry[block] == first_entry[block + 1]) return;
  const BodyLanes& body = store.body[b];
  const double inverse = 1 / store.model.inertia.x;
  CacheLine motion[lane_width], turning[lane_width];
  const LaneVec3 &x = body.position, &v = body.velocity, spin = inverse * body.angular_momentum;
  to_records({x.x, x.y, x.z, broadcast(store.model.radius[0]), v.x, v.y, v.z, broadcast(store.model.mass)},
             motion);
  to_records({spin.x, spin.y, spin.z, broadcast(store.model.inertia.x), Lanes{}, Lanes{}, Lanes{}, Lanes{}},
             turning);
  for (int e = first_entry[block]; e < first_entry[block + 1]; ++e)
    all_bodies.state[e] = {motion[places[e].lane], turning[places[e].lane]};
}

// With the axes X, Y, Z of a seed's template and their rates spin x X, ..., a sub-sphere at (a, b, c) has
//   (position, velocity) = (x, v) + a (X, spin x X) + b (Y, spin x Y) + c (Z, spin x Z).
void Contacts::place_rigid(int block, const SeedStore& store, int b) {
  if (first_entry[block] == first_entry[block + 1]) return;
  const BodyLanes& body = store.body[b];
  const RigidFrame frame(body, store.model.inertia);
  CacheLine centre[lane_width], axis[3][lane_width], spin[lane_width];
  const LaneVec3 &x = body.position, &v = body.velocity;
  to_records({x.x, x.y, x.z, Lanes{}, v.x, v.y, v.z, Lanes{}}, centre);
  const LaneVec3* const axes[3] = {&frame.x, &frame.y, &frame.z};
  for (int c = 0; c < 3; ++c) {
    const LaneVec3 &a = *axes[c], rate = cross(frame.spin, a);
    to_records({a.x, a.y, a.z, Lanes{}, rate.x, rate.y, rate.z, Lanes{}}, axis[c]);
  }
  const Lanes inertia = broadcast(store.model.inertia.x);
  to_records({frame.spin.x, frame.spin.y, frame.spin.z, inertia, Lanes{}, Lanes{}, Lanes{}, Lanes{}}, spin);
  for (int e = first_entry[block]; e < first_entry[block + 1]; ++e) {
    const int lane = places[e].lane, i = places[e].sphere;
    const Vec3& r = store.model.position[i];
    CacheLine arm, state;
    for (int c = 0; c < 8; ++c) {
      arm[c] = r.x * axis[0][lane][c] + r.y * axis[1][lane][c] + r.z * axis[2][lane][c];
      state[c] = centre[lane][c] + arm[c];
    }
    state[3] = store.model.radius[i], state[7] = store.model.mass;
    CacheLine turning = spin[lane];
    turning[4] = arm[0], turning[5] = arm[1], turning[6] = arm[2];
    all_bodies.state[e] = {state, turning};
  }
}

}  // namespace seedflow
