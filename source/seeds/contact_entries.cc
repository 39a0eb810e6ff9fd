// From the stores' lanes to the records of the contacts and back.

#include <algorithm>

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
  const CacheLine zero{};
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
  if (first_entry[block] == first_entry[block + 1]) return;
  if (!store.rigid)
    place_bonded(block, store, b);
  else if (store.n_spheres() == 1)
    place_plain_spheres(block, store, b);
  else
    place_rigid(block, store, b);
}

void Contacts::place_bonded(int block, const SeedStore& store, int b) {
  const SphereLanes* const spheres = store.block(b);
  const bool levers = all_bodies.levers();
  for (int e = first_entry[block]; e < first_entry[block + 1]; ++e) {
    const SphereLanes& s = spheres[places[e].sphere];
    const int lane = places[e].lane, body = all_bodies.body[e];
    ContactSphere& state = all_bodies.state[e];
    ContactMotion& motion = all_bodies.motion[body];
    state[0] = s.position.x[lane], state[1] = s.position.y[lane], state[2] = s.position.z[lane];
    motion[0] = s.velocity.x[lane], motion[1] = s.velocity.y[lane], motion[2] = s.velocity.z[lane];
    motion[4] = s.angular_velocity.x[lane], motion[5] = s.angular_velocity.y[lane];
    motion[6] = s.angular_velocity.z[lane];
    if (levers) all_bodies.centre[body] = {{state[0], state[1], state[2], 0}};
  }
}

void Contacts::place_plain_spheres(int block, const SeedStore& store, int b) {
  const BodyLanes& body = store.body[b];
  const double inverse = 1 / store.model.inertia.x;
  const bool levers = all_bodies.levers();
  ContactSphere sphere[lane_width];
  ContactMotion motion[lane_width];
  const LaneVec3 &x = body.position, &v = body.velocity, spin = inverse * body.angular_momentum;
  to_records({x.x, x.y, x.z, broadcast(store.model.radius[0])}, sphere);
  to_records(
      {v.x, v.y, v.z, broadcast(store.model.mass), spin.x, spin.y, spin.z, broadcast(store.model.inertia.x)},
      motion);
  for (int e = first_entry[block]; e < first_entry[block + 1]; ++e) {
    const int lane = places[e].lane, entry_body = all_bodies.body[e];
    all_bodies.state[e] = sphere[lane];
    all_bodies.motion[entry_body] = motion[lane];
    if (levers) all_bodies.centre[entry_body] = sphere[lane];
  }
}

// With the axes X, Y, Z of a seed's template a sub-sphere at (a, b, c) is at x + a X + b Y + c Z.
void Contacts::place_rigid(int block, const SeedStore& store, int b) {
  const BodyLanes& body = store.body[b];
  const RigidFrame frame(body, store.model.inertia);
  HalfLine centre[lane_width], axis[3][lane_width];
  ContactMotion motion[lane_width];
  const LaneVec3 &x = body.position, &v = body.velocity, &w = frame.spin;
  to_records({x.x, x.y, x.z, Lanes{}}, centre);
  const LaneVec3* const axes[3] = {&frame.x, &frame.y, &frame.z};
  for (int c = 0; c < 3; ++c) to_records({axes[c]->x, axes[c]->y, axes[c]->z, Lanes{}}, axis[c]);
  const Vec3& inertia = store.model.inertia;
  to_records({v.x, v.y, v.z, broadcast(store.model.mass), w.x, w.y, w.z,
              broadcast(std::min({inertia.x, inertia.y, inertia.z}))},
             motion);
  const Vec3* const position = store.model.position.data();
  const double* const radius = store.model.radius.data();
  int last = -1;
  for (int e = first_entry[block]; e < first_entry[block + 1]; ++e) {
    const int lane = places[e].lane, i = places[e].sphere;
    if (all_bodies.body[e] != last) {
      last = all_bodies.body[e];
      all_bodies.motion[last] = motion[lane];
      all_bodies.centre[last] = centre[lane];
    }
    const Vec3& r = position[i];
    HalfRow at = centre[lane].row() + r.x * axis[0][lane].row() + r.y * axis[1][lane].row() +
                 r.z * axis[2][lane].row();
    at[3] = radius[i];
    all_bodies.state[e].set(at);
  }
}

}  // namespace seedflow
