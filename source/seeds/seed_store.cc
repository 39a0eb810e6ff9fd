#include "seedflow/seeds/seed_store.h"

#include <utility>

#include "seedflow/seeds/copy_lane.h"

namespace seedflow {

void SeedStore::add_block() {
  const std::size_t b = n_blocks();
  occupied.push_back(Lanes{});
  if (!load.empty()) load.resize((b + 1) * n_spheres());
  if (rigid) {
    body.emplace_back();
    body_force.emplace_back();
    return;
  }
  sphere.resize((b + 1) * n_spheres());
  force.resize(sphere.size());
  for (int i = 0; i < n_spheres(); ++i)
    for (int l = 0; l < lane_width; ++l) block(b)[i].position.set(l, model.position[i]);
}

int SeedStore::add(int seed_number, const Vec3& centre, const Quaternion& orientation, const Vec3& velocity,
                   const Vec3& spin) {
  const int slot = static_cast<int>(seed.size());
  const int lane = slot % lane_width, b = slot / lane_width;
  if (lane == 0) add_block();
  seed.push_back(seed_number);
  occupied[b][lane] = 1.0;
  if (rigid) {
    const Vec3 w = rotate_back(orientation, spin);
    const Vec3 momentum{model.inertia.x * w.x, model.inertia.y * w.y, model.inertia.z * w.z};
    body[b].position.set(lane, centre);
    body[b].orientation.set(lane, orientation);
    body[b].velocity.set(lane, velocity);
    body[b].angular_momentum.set(lane, rotate(orientation, momentum));
    return slot;
  }
  for (int i = 0; i < n_spheres(); ++i) {
    const Vec3 arm = rotate(orientation, model.position[i]);
    SphereLanes& s = block(b)[i];
    s.position.set(lane, centre + arm);
    s.orientation.set(lane, orientation);
    s.velocity.set(lane, velocity + cross(spin, arm));
    s.angular_velocity.set(lane, spin);
  }
  return slot;
}

Vec3 SeedStore::body_spin(int slot) const {
  const BodyLanes& own = body[slot / lane_width];
  const Quaternion q = own.orientation.get(slot % lane_width);
  const Vec3 l = rotate_back(q, own.angular_momentum.get(slot % lane_width));
  return rotate(q, {l.x / model.inertia.x, l.y / model.inertia.y, l.z / model.inertia.z});
}

void SeedStore::rearrange(const std::vector<int>& from) {
  SeedStore old = std::move(*this);
  *this = SeedStore{};
  model = old.model, material = old.material, rigid = old.rigid;
  if (!old.load.empty() && !from.empty()) load.resize(1);
  const int n = n_spheres();
  const std::size_t blocks = (from.size() + lane_width - 1) / lane_width;
  seed.reserve(from.size()), occupied.reserve(blocks);
  if (rigid)
    body.reserve(blocks), body_force.reserve(blocks);
  else
    sphere.reserve(blocks * n), force.reserve(blocks * n);
  for (std::size_t k = 0; k < from.size(); ++k) {
    const int lane = static_cast<int>(k) % lane_width, b = static_cast<int>(k) / lane_width;
    const int old_lane = from[k] % lane_width, old_b = from[k] / lane_width;
    if (lane == 0) add_block();
    seed.push_back(old.seed[from[k]]);
    occupied[b][lane] = 1.0;
    if (loads(b)) copy_lane(loads(b), lane, old.loads(old_b), old_lane, n);
    if (rigid) {
      copy_lane(&body[b], lane, &old.body[old_b], old_lane, 1);
      copy_lane(&body_force[b], lane, &old.body_force[old_b], old_lane, 1);
    } else {
      copy_lane(block(b), lane, old.block(old_b), old_lane, n);
      copy_lane(forces(b), lane, old.forces(old_b), old_lane, n);
    }
  }
}

std::size_t SeedStore::bytes() const {
  return sphere.capacity() * sizeof(SphereLanes) +
         (force.capacity() + body_force.capacity()) * sizeof(ForceLanes) +
         load.capacity() * sizeof(LoadLanes) + body.capacity() * sizeof(BodyLanes) +
         rigid_load.capacity() * sizeof(RigidLoad) + occupied.capacity() * sizeof(Lanes) +
         seed.capacity() * sizeof(int);
}

}  // namespace seedflow
