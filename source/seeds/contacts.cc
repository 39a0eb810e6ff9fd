#include "seedflow/seeds/contacts.h"

#include <algorithm>
#include <cmath>

#include "seedflow/base/binary.h"
#include "seedflow/base/parameters.h"

namespace seedflow {
namespace {

// Distance from the centre of mass that the body's rotation is about to a point.
double rolling_radius(const SphereAddress& s, const Vec3& point) {
  return norm(point - (s.body ? s.body->position.get(s.lane) : s.lanes->position.get(s.lane)));
}

Vec3 rolling_torque(const Vec3& rotation, double size, double inertia, double step) {
  const double speed = norm(rotation);
  if (!(speed > 0) || !(size > 0)) return {};
  return (-std::min(size, step > 0 ? inertia * speed / step : size) / speed) * rotation;
}

}  // namespace

void ContactParameters::declare(Parameters& p) {
  const auto section = p.section("Contacts", "Contacts of seeds with each other and with walls.");
  p.number(
      "Skin", skin, "m", Range::non_negative(),
      "Contact lists hold pairs of sub-spheres with gaps below this. 0: a quarter of the smallest radius.");
}

void Contacts::set_law(int a, int b, const ContactLaw& contact_law) {
  const std::size_t n = std::max<std::size_t>(laws.size(), std::max(a, b) + 1);
  laws.resize(n);
  for (auto& row : laws) row.resize(n);
  laws[a][b] = laws[b][a] = contact_law;
}

void Contacts::add_forces(const std::vector<SphereAddress>& spheres, const std::vector<Wall>& walls,
                          double step, std::vector<Vec3>& wall_force) {
  for (Pair& pair : pairs) {
    const SphereAddress &a = spheres[pair.first], &b = spheres[pair.second];
    const Vec3 d = a.lanes->position.get(a.lane) - b.lanes->position.get(b.lane);
    const double reach2 = (a.radius + b.radius) * (a.radius + b.radius), distance2 = norm_square(d);
    if (distance2 >= reach2) {
      if (pair.touching) pair.spring = {}, pair.touching = false;
      continue;
    }
    pair.touching = true;
    const double distance = std::sqrt(distance2);
    ContactState c;
    c.normal = distance > 0 ? d / distance : Vec3{0, 0, 1};
    c.overlap = a.radius + b.radius - distance;
    c.reduced_radius = a.radius * b.radius / (a.radius + b.radius);
    c.reduced_mass = a.mass * b.mass / (a.mass + b.mass);
    const Vec3 arm_a = -(a.radius - 0.5 * c.overlap) * c.normal,
               arm_b = (b.radius - 0.5 * c.overlap) * c.normal;
    const Vec3 spin_a = a.lanes->angular_velocity.get(a.lane), spin_b = b.lanes->angular_velocity.get(b.lane);
    c.velocity = a.lanes->velocity.get(a.lane) + cross(spin_a, arm_a) - b.lanes->velocity.get(b.lane) -
                 cross(spin_b, arm_b);
    const ContactLaw& own = law(a.material, b.material);
    const ContactForce f = contact_force(own, c, step, pair.spring);
    const Vec3 point = a.lanes->position.get(a.lane) + arm_a;
    const double ra = rolling_radius(a, point), rb = rolling_radius(b, point);
    const Vec3 rolling =
        rolling_torque(spin_a - spin_b, own.rolling_friction * f.repulsion * 2 * ra * rb / (ra + rb),
                       a.inertia * b.inertia / (a.inertia + b.inertia), step);
    pair.normal_force = f.repulsion;
    *a.in_contact = *b.in_contact = 1;
    a.force->force.add(a.lane, f.force);
    b.force->force.add(b.lane, -f.force);
    a.force->torque.add(a.lane, cross(arm_a, f.force) + rolling);
    b.force->torque.add(b.lane, -cross(arm_b, f.force) - rolling);
  }
  wall_force.assign(walls.size(), Vec3{});
  for (Pair& pair : wall_pairs) {
    const SphereAddress& a = spheres[pair.first];
    const Wall& wall = walls[pair.second];
    const Vec3 x = a.lanes->position.get(a.lane);
    ContactState c;
    c.overlap = a.radius - dot(x - wall.point, wall.normal);
    if (c.overlap <= 0) {
      if (pair.touching) pair.spring = {}, pair.touching = false;
      continue;
    }
    pair.touching = true;
    c.normal = wall.normal;
    c.reduced_radius = a.radius;
    c.reduced_mass = a.mass;
    const Vec3 arm = -(a.radius - c.overlap) * c.normal, spin = a.lanes->angular_velocity.get(a.lane);
    c.velocity = a.lanes->velocity.get(a.lane) + cross(spin, arm) - wall.velocity;
    const ContactLaw& own = law(a.material, wall.material);
    const ContactForce f = contact_force(own, c, step, pair.spring);
    const Vec3 rolling = rolling_torque(spin, own.rolling_friction * f.repulsion * rolling_radius(a, x + arm),
                                        a.inertia, step);
    pair.normal_force = f.repulsion;
    *a.in_contact = 1;
    a.force->force.add(a.lane, f.force);
    a.force->torque.add(a.lane, cross(arm, f.force) + rolling);
    wall_force[pair.second] += f.force;
  }
}

void Contacts::renumber(const std::vector<int>& new_number) {
  const auto move = [&](std::vector<Pair>& list, bool both) {
    std::size_t kept = 0;
    for (const Pair& old : list) {
      Pair pair = old;
      pair.first = new_number[old.first];
      if (both) pair.second = new_number[old.second];
      if (pair.first >= 0 && pair.second >= 0) list[kept++] = pair;
    }
    list.resize(kept);
  };
  move(pairs, true);
  move(wall_pairs, false);
  forget();
}

int Contacts::n_touching() const {
  const auto touches = [](const Pair& p) { return p.touching; };
  return static_cast<int>(std::count_if(pairs.begin(), pairs.end(), touches) +
                          std::count_if(wall_pairs.begin(), wall_pairs.end(), touches));
}

double Contacts::largest_overlap(const std::vector<SphereAddress>& spheres, const std::vector<Wall>& walls,
                                 Pair& where, bool& is_wall) const {
  double largest = 0;
  const auto look = [&](const Pair& pair, double overlap, bool wall) {
    if (overlap > largest) largest = overlap, where = pair, is_wall = wall;
  };
  const auto place = [&](int i) { return spheres[i].lanes->position.get(spheres[i].lane); };
  for (const Pair& p : pairs)
    look(p, spheres[p.first].radius + spheres[p.second].radius - norm(place(p.first) - place(p.second)),
         false);
  for (const Pair& p : wall_pairs)
    look(p, spheres[p.first].radius - dot(place(p.first) - walls[p.second].point, walls[p.second].normal),
         true);
  return largest;
}

void Contacts::save(std::ostream& out) const {
  write_binary(out, pairs);
  write_binary(out, wall_pairs);
  write_binary(out, reach);
  write_binary(out, travelled);
}

void Contacts::load(std::istream& in) {
  read_binary(in, pairs);
  read_binary(in, wall_pairs);
  read_binary(in, reach);
  read_binary(in, travelled);
}

}  // namespace seedflow
