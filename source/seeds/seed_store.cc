#include "seedflow/seeds/seed_store.h"

namespace seedflow {

int SeedStore::add(int seed_number, const Vec3& centre, const Quaternion& orientation, const Vec3& velocity,
                   const Vec3& spin) {
  const int n = n_spheres();
  const int slot = static_cast<int>(seed.size());
  const int lane = slot % lane_width, b = slot / lane_width;
  if (lane == 0) {
    occupied.push_back(Lanes{});
    sphere.resize(static_cast<std::size_t>(b + 1) * n);
    force.resize(sphere.size());
    in_contact.push_back(0);
    if (rigid) body.emplace_back();
    if (!load.empty()) load.resize(sphere.size());
    for (int i = 0; i < n; ++i)
      for (int l = 0; l < lane_width; ++l) block(b)[i].position.set(l, model.position[i]);
  }
  seed.push_back(seed_number);
  occupied[b][lane] = 1.0;
  for (int i = 0; i < n; ++i) {
    const Vec3 arm = rotate(orientation, model.position[i]);
    SphereLanes& s = block(b)[i];
    s.position.set(lane, centre + arm);
    s.orientation.set(lane, orientation);
    s.velocity.set(lane, velocity + cross(spin, arm));
    s.angular_velocity.set(lane, spin);
  }
  if (rigid) {
    const Vec3 w = rotate_back(orientation, spin);
    const Vec3 momentum{model.inertia.x * w.x, model.inertia.y * w.y, model.inertia.z * w.z};
    body[b].position.set(lane, centre);
    body[b].orientation.set(lane, orientation);
    body[b].velocity.set(lane, velocity);
    body[b].angular_momentum.set(lane, rotate(orientation, momentum));
  }
  return slot;
}

std::size_t SeedStore::bytes() const {
  return sphere.capacity() * sizeof(SphereLanes) + force.capacity() * sizeof(ForceLanes) +
         in_contact.capacity() + load.capacity() * sizeof(LoadLanes) + body.capacity() * sizeof(BodyLanes) +
         rigid_load.capacity() * sizeof(RigidLoad) + occupied.capacity() * sizeof(Lanes) +
         seed.capacity() * sizeof(int);
}

}  // namespace seedflow
