// Looking at a Dem.

#include <algorithm>
#include <cmath>

#include "seedflow/seeds/dem.h"

namespace seedflow {
namespace {

// The rotation that carries the arms of the template best onto the present ones: quaternions of the
// sub-spheres, weighted with mass, signs aligned with the first.
Quaternion mean_orientation(const std::vector<Quaternion>& q, const std::vector<double>& weight) {
  Quaternion sum{0, {}};
  for (std::size_t i = 0; i < q.size(); ++i) {
    const double s = q[0].w * q[i].w + dot(q[0].v, q[i].v) < 0 ? -weight[i] : weight[i];
    sum.w += s * q[i].w;
    sum.v += s * q[i].v;
  }
  return normalized(sum);
}

// Solves the symmetric 3 x 3 system A x = b by Cramer's rule.
Vec3 solve(const Vec3& r0, const Vec3& r1, const Vec3& r2, const Vec3& b) {
  const double det = dot(r0, cross(r1, r2));
  return (b.x * cross(r1, r2) + b.y * cross(r2, r0) + b.z * cross(r0, r1)) / det;
}

}  // namespace

template <class F>
void Dem::for_each_seed(const F& f) const {
  for (int seed = 0; seed < n_seeds(); ++seed) f(store[slots[seed].store], slots[seed].slot, first[seed]);
}

void Dem::positions(std::vector<Vec3>& out) const {
  out.resize(n_spheres());
  for_each_seed([&](const SeedStore& s, int slot, int begin) {
    s.positions(slot, [&](int i, const Vec3& x) { out[begin + i] = x; });
  });
}
void Dem::velocities(std::vector<Vec3>& out) const {
  out.resize(n_spheres());
  for_each_seed([&](const SeedStore& s, int slot, int begin) {
    s.velocities(slot, [&](int i, const Vec3& v, const Vec3&) { out[begin + i] = v; });
  });
}
void Dem::angular_velocities(std::vector<Vec3>& out) const {
  out.resize(n_spheres());
  for_each_seed([&](const SeedStore& s, int slot, int begin) {
    s.velocities(slot, [&](int i, const Vec3&, const Vec3& w) { out[begin + i] = w; });
  });
}

void Dem::fluid_impulses(std::vector<Vec3>& out) const {
  out.assign(n_spheres(), Vec3{});
  for (int seed = 0, k = 0; seed < n_seeds(); ++seed) {
    const SeedStore& s = store[slots[seed].store];
    const int lane = slots[seed].slot % lane_width;
    if (s.load.empty()) {
      k += s.n_spheres();
      continue;
    }
    const LoadLanes* own =
        s.load.data() + static_cast<std::size_t>(slots[seed].slot / lane_width) * s.n_spheres();
    for (int i = 0; i < s.n_spheres(); ++i, ++k) out[k] = own[i].impulse.get(lane);
  }
}

int Dem::seed_of_sphere(int sphere) const {
  return static_cast<int>(std::upper_bound(first.begin(), first.end(), sphere) - first.begin()) - 1;
}
const SeedTemplate& Dem::seed_template(int seed) const {
  return store[slots[seed].store].model;
}
bool Dem::is_rigid(int seed) const {
  return store[slots[seed].store].rigid;
}

SeedState Dem::seed_state(int seed) const {
  const SeedStore& s = store[slots[seed].store];
  const int lane = slots[seed].slot % lane_width, b = slots[seed].slot / lane_width, n = s.n_spheres();
  SeedState r;
  if (s.rigid) {
    const BodyLanes& body = s.body[b];
    r.centre = body.position.get(lane);
    r.velocity = body.velocity.get(lane);
    r.orientation = body.orientation.get(lane);
    r.angular_momentum = body.angular_momentum.get(lane);
    r.spin = s.body_spin(slots[seed].slot);
    return r;
  }
  const SphereLanes* own = s.block(b);
  std::vector<Quaternion> q(n);
  for (int i = 0; i < n; ++i) {
    const double m = s.model.sphere_mass[i] / s.model.mass;
    r.centre += m * own[i].position.get(lane);
    r.velocity += m * own[i].velocity.get(lane);
    q[i] = own[i].orientation.get(lane);
  }
  r.orientation = mean_orientation(q, s.model.sphere_mass);
  Vec3 row[3];
  for (int i = 0; i < n; ++i) {
    const double m = s.model.sphere_mass[i], own_inertia = s.model.sphere_inertia[i];
    const Vec3 arm = own[i].position.get(lane) - r.centre;
    r.angular_momentum += m * cross(arm, own[i].velocity.get(lane) - r.velocity) +
                          own_inertia * own[i].angular_velocity.get(lane);
    for (int k = 0; k < 3; ++k) {
      row[k] -= m * arm[k] * arm;
      row[k][k] += m * norm_square(arm) + own_inertia;
    }
  }
  r.spin = solve(row[0], row[1], row[2], r.angular_momentum);
  return r;
}

Vec3 Dem::contact_force(int seed) const {
  const SeedStore& s = store[slots[seed].store];
  const int lane = slots[seed].slot % lane_width, b = slots[seed].slot / lane_width;
  if (s.rigid) return s.body_force[b].force.get(lane);
  // The forces of bonds cancel within the seed.
  Vec3 sum;
  for (int i = 0; i < s.n_spheres(); ++i)
    sum += s.force[static_cast<std::size_t>(b) * s.n_spheres() + i].force.get(lane);
  return sum;
}

DemEnergies Dem::energies() const {
  DemEnergies e;
  for (std::size_t t = 0; t < store.size(); ++t) {
    const SeedStore& s = store[t];
    for (int b = 0; b < s.n_blocks(); ++b) {
      if (!s.rigid) e.bonds += lane_sum(s.occupied[b] * bonds[t].energy(s.block(b), b));
      Lanes kinetic = {};
      for (int i = 0; i < s.n_spheres() && !s.rigid; ++i) {
        const SphereLanes& l = s.block(b)[i];
        kinetic += (0.5 * s.model.sphere_mass[i]) * dot(l.velocity, l.velocity) +
                   (0.5 * s.model.sphere_inertia[i]) * dot(l.angular_velocity, l.angular_velocity);
      }
      e.kinetic += lane_sum(s.occupied[b] * kinetic);
    }
    e.dissipated += bonds[t].dissipated_energy();
  }
  for (int seed = 0; seed < n_seeds(); ++seed) {
    const SeedState s = seed_state(seed);
    const double mass = seed_template(seed).mass;
    e.potential -= mass * dot(parameters.gravity, s.centre);
    if (is_rigid(seed))
      e.kinetic += 0.5 * mass * norm_square(s.velocity) + 0.5 * dot(s.spin, s.angular_momentum);
  }
  return e;
}

Vec3 Dem::momentum() const {
  Vec3 sum;
  for (int seed = 0; seed < n_seeds(); ++seed) sum += seed_template(seed).mass * seed_state(seed).velocity;
  return sum;
}

double Dem::max_speed() const {
  std::vector<Vec3> v;
  velocities(v);
  double fastest = 0;
  for (const Vec3& a : v) fastest = std::max(fastest, norm_square(a));
  return std::sqrt(fastest);
}

int Dem::n_broken_bonds(int seed) const {
  return bonds[slots[seed].store].n_broken(slots[seed].slot / lane_width, slots[seed].slot % lane_width);
}

int Dem::n_broken_bonds() const {
  int sum = 0;
  for (int seed = 0; seed < n_seeds(); ++seed) sum += n_broken_bonds(seed);
  return sum;
}

std::size_t Dem::bytes() const {
  std::size_t sum = sphere_radius.capacity() * sizeof(double) + sphere_mass.capacity() * sizeof(double) +
                    slots.capacity() * sizeof(Slot) + first.capacity() * sizeof(int) +
                    labels.capacity() * sizeof(long) + groups.capacity() * sizeof(int) +
                    block_impulse.capacity() * sizeof(Vec3) + contacts.bytes() + travel.bytes() +
                    merged.pairs.capacity() * sizeof(ContactHistory::Pair) +
                    merged.on_wall.capacity() * sizeof(ContactHistory::OnWall);
  for (const SeedStore& s : store) sum += s.bytes();
  for (const Bonds& b : bonds) sum += b.bytes();
  return sum;
}

}  // namespace seedflow
