#include "seedflow/seeds/dem.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "seedflow/base/error.h"
#include "seedflow/seeds/motion.h"
#include "seedflow/seeds/rigid_load.h"

namespace seedflow {

Dem::Dem(const DemParameters& dem_parameters, MPI_Comm dem_communicator)
    : parameters(dem_parameters), communicator(dem_communicator) {}

SphereLanes& Dem::lanes_of(int seed, int sphere, int& lane) {
  SeedStore& s = store[slots[seed].store];
  lane = slots[seed].slot % lane_width;
  return s.block(slots[seed].slot / lane_width)[sphere];
}

const SphereLanes& Dem::lanes_of(int seed, int sphere, int& lane) const {
  return const_cast<Dem*>(this)->lanes_of(seed, sphere, lane);
}

void Dem::set_loads(const SphereLoads& loads) {
  const auto fits = [&](const auto& v, const char* name) {
    if (!v.empty() && v.size() != static_cast<std::size_t>(n_spheres()))
      throw InputError("Loads on the seeds: '" + std::string(name) + "' has " + std::to_string(v.size()) +
                       " entries, expected 0 or one per sub-sphere (" + std::to_string(n_spheres()) + ").");
  };
  fits(loads.force, "force");
  fits(loads.torque, "torque");
  fits(loads.drag_coefficient, "drag_coefficient");
  fits(loads.flow_velocity, "flow_velocity");
  fits(loads.added_mass, "added_mass");
  const auto all_non_negative = [](const std::vector<double>& v) {
    return std::all_of(v.begin(), v.end(), [](double a) { return a >= 0; });
  };
  if (!all_non_negative(loads.drag_coefficient) || !all_non_negative(loads.added_mass))
    throw RunError(
        "Loads on the seeds at t = " + std::to_string(now) +
        " s: a drag coefficient or added mass is negative or not a number. Check the velocity of the "
        "air and the effects that are switched on.");
  for (SeedStore& s : store) s.load.resize(s.sphere.size());
  for (int seed = 0, k = 0; seed < n_seeds(); ++seed) {
    SeedStore& s = store[slots[seed].store];
    const int lane = slots[seed].slot % lane_width;
    LoadLanes* const own = s.loads(slots[seed].slot / lane_width);
    for (int i = 0; i < s.n_spheres(); ++i, ++k) {
      own[i].force.set(lane, loads.force.empty() ? Vec3{} : loads.force[k]);
      own[i].torque.set(lane, loads.torque.empty() ? Vec3{} : loads.torque[k]);
      own[i].flow.set(lane, loads.flow_velocity.empty() ? Vec3{} : loads.flow_velocity[k]);
      own[i].drag[lane] = loads.drag_coefficient.empty() ? 0.0 : loads.drag_coefficient[k];
      own[i].added_mass[lane] = loads.added_mass.empty() ? 0.0 : loads.added_mass[k];
    }
  }
  load_step = 0;
}

void Dem::relax_factors(double step) {
  if (load_step == step) return;
  const auto relaxed = [](double z) { return z > 0 ? -std::expm1(-z) / z : 1.0; };
  for (SeedStore& s : store) {
    if (s.rigid) continue;
    for (std::size_t k = 0; k < s.load.size(); ++k) {
      LoadLanes& l = s.load[k];
      const double mass = s.model.sphere_mass[k % s.n_spheres()];
      for (int lane = 0; lane < lane_width; ++lane) {
        const double z = l.drag[lane] * step / (mass + l.added_mass[lane]);
        l.relaxed_full[lane] = relaxed(z);
        l.relaxed_half[lane] = relaxed(0.5 * z);
      }
    }
  }
  load_step = step;
}

void Dem::begin_impulses(double step) {
  for (SeedStore& s : store) {
    for (LoadLanes& l : s.load) l.impulse = LaneVec3{};
    if (!s.rigid || s.load.empty()) continue;
    s.rigid_load.resize(s.seed.size());
    for (std::size_t slot = 0; slot < s.seed.size(); ++slot)
      s.rigid_load[slot] = reduce_loads(s.model, s.loads(slot / lane_width), slot % lane_width, step);
  }
}

void Dem::end_impulses(double duration) {
  for (SeedStore& s : store)
    for (std::size_t slot = 0; slot < s.rigid_load.size(); ++slot)
      spread_impulses(s.rigid_load[slot], s.model, s.loads(slot / lane_width), slot % lane_width, duration);
}

void Dem::refresh_addresses() {
  // A copy of a Dem brings along the addresses of the original: they are told by the first.
  int lane = 0;
  const bool valid = static_cast<int>(address.size()) == n_spheres() &&
                     (address.empty() || address.front().lanes == &lanes_of(0, 0, lane));
  if (valid) return;
  address.clear();
  for (int seed = 0; seed < n_seeds(); ++seed) {
    SeedStore& s = store[slots[seed].store];
    const int b = slots[seed].slot / lane_width;
    const Vec3& inertia = s.model.inertia;
    for (int i = 0; i < s.n_spheres(); ++i) {
      SphereAddress a;
      a.lanes = s.block(b) + i;
      a.force = s.forces(b) + i;
      a.in_contact = &s.in_contact[b];
      a.body = s.rigid ? &s.body[b] : nullptr;
      a.lane = slots[seed].slot % lane_width;
      a.seed = seed;
      a.material = s.material;
      a.radius = s.model.radius[i];
      a.mass = s.rigid ? s.model.mass : s.model.sphere_mass[i];
      a.inertia = s.rigid ? std::min({inertia.x, inertia.y, inertia.z}) : s.model.sphere_inertia[i];
      address.push_back(a);
    }
  }
}

void Dem::sum_contacts(double step) {
  double fastest = largest_speed;
  for (Wall& w : all_walls) {
    w.point += step * w.velocity;
    fastest = std::max(fastest, norm(w.velocity));
  }
  if (!contacts.is_listed() || contacts.moved(fastest * step))
    contacts.search(address, first, all_walls, wall_active, parameters.contacts);
  contacts.add_forces(address, all_walls, step, wall_force);
}

void Dem::sum_bonds(double step) {
  for (std::size_t t = 0; t < store.size(); ++t)
    for (int b = 0; b < store[t].n_blocks() && !store[t].rigid; ++b)
      bonds[t].add_forces(store[t].block(b), store[t].forces(b), b, step);
}

void Dem::move(double bond_step, const MotionStep& motion) {
  double fastest = 0;
  for (std::size_t t = 0; t < store.size(); ++t) {
    SeedStore& s = store[t];
    scratch.assign(s.rigid ? 0 : s.n_spheres(), ForceLanes{});
    for (int b = 0; b < s.n_blocks(); ++b) {
      // Only a block in contact, and every block where the forces are kept (first and last kick), has its own
      // forces.
      const bool own = s.in_contact[b] || bond_step == 0 || motion.drift == 0;
      if (s.rigid) {
        fastest = std::max(fastest, move_rigid(s, b, own ? s.forces(b) : nullptr, motion));
      } else {
        ForceLanes* const forces = own ? s.forces(b) : scratch.data();
        // Bonds and motion of a block follow each other while the block is in the cache.
        if (bond_step > 0) {
          NextBlock next;
          if (b + 1 < s.n_blocks()) {
            next.spheres = s.block(b + 1);
            if (s.in_contact[b + 1]) next.forces = s.forces(b + 1);
          }
          bonds[t].add_forces(s.block(b), forces, b, bond_step, next);
        }
        fastest = std::max(fastest, move_bonded(s, b, forces, motion));
      }
      s.in_contact[b] = 0;
    }
  }
  largest_speed = std::sqrt(fastest);
  for (std::size_t w = 0; w < all_walls.size(); ++w) wall_impulse[w] += motion.kick * wall_force[w];
}

void Dem::advance(double duration) {
  if (!(duration > 0)) return;
  const long n = std::max(1L, std::lround(std::ceil(duration / parameters.time_step * (1 - 1e-12))));
  const double step = duration / n;
  refresh_addresses();
  if (!forces_known) {
    for (SeedStore& s : store) std::fill(s.force.begin(), s.force.end(), ForceLanes{});
    contacts.forget();
    sum_contacts(0);
    sum_bonds(0);
    forces_known = true;
  }
  relax_factors(step);
  begin_impulses(step);
  // Velocity Verlet; the second half kick of one substep and the first of the next are one.
  move(0, {0.5 * step, step, true, parameters.gravity});
  for (long k = 1; k <= n; ++k) {
    sum_contacts(step);
    if (k < n)
      move(step, {step, step, false, parameters.gravity});
    else
      move(step, {0.5 * step, 0, true, parameters.gravity});
  }
  end_impulses(duration);
  substeps += n;
  now += duration;
  check_state();
}

void Dem::check_state() const {
  for (const SeedStore& s : store)
    for (int b = 0; b < s.n_blocks(); ++b) {
      LaneVec3 centre, speed;
      for (int i = 0; i < s.n_spheres(); ++i) {
        const double share = s.model.sphere_mass[i] / s.model.mass;
        centre += share * s.block(b)[i].position;
        speed += share * s.block(b)[i].velocity;
      }
      for (int lane = 0; lane < lane_width; ++lane)
        if (s.occupied[b][lane] != 0.0)
          check_seed(s, b * lane_width + lane, centre.get(lane), speed.get(lane));
    }
}

void Dem::check_seed(const SeedStore& s, int slot, const Vec3& x, const Vec3& v) const {
  const bool number = std::isfinite(x.x + x.y + x.z + v.x + v.y + v.z);
  const bool inside = !bounded || (x.x >= low.x && x.y >= low.y && x.z >= low.z && x.x <= high.x &&
                                   x.y <= high.y && x.z <= high.z);
  if (number && inside) return;
  std::ostringstream where;
  where << "seed " << s.seed[slot] << " ('" << s.model.name << "') at (" << x.x << ", " << x.y << ", " << x.z
        << ") m, t = " << now << " s";
  if (!number)
    throw RunError("The motion of the seeds failed: not a number in " + where.str() +
                   ". Reduce the time step or look at the forces on this seed.");
  throw RunError("A seed left the domain: " + where.str() +
                 ". Close the domain with walls, enlarge it, or end the run earlier.");
}

}  // namespace seedflow
