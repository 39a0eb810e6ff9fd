// Where seeds stand in memory and which rank computes them.

#include <algorithm>
#include <cmath>
#include <sstream>

#include "seedflow/base/error.h"
#include "seedflow/seeds/curve.h"
#include "seedflow/seeds/dem.h"

namespace seedflow {
namespace {

// Seeds drift apart slowly: sorting more often than this gains nothing.
constexpr long substeps_between_sortings = 10000;

// Nanoseconds per substep on one core of 2021, measured by the benches; only their ratios matter.
constexpr double cost_of_bonded_sphere = 16, cost_of_body = 30, cost_of_contact = 60;

}  // namespace

void Dem::number() {
  numbering = Numbering(store);
  share.extend(store);
  first_block.assign(1, 0);
  for (const SeedStore& s : store) first_block.push_back(first_block.back() + s.n_blocks());
  block_impulse.assign(first_block.back() * all_walls.size(), Vec3{});
  order_blocks();
}

bool Dem::arrangement_is_due() const {
  return arranged_at < 0 || substeps - arranged_at >= substeps_between_sortings ||
         std::abs(n_seeds() - arranged_seeds) > 0.1 * arranged_seeds;
}

void Dem::arrange() {
  park();
  const std::vector<unsigned long long> key = curve_keys(centres());
  std::vector<std::vector<int>> order(store.size());
  for (int seed = 0; seed < n_seeds(); ++seed) order[slots[seed].store].push_back(seed);
  for (std::size_t t = 0; t < store.size(); ++t) {
    std::sort(order[t].begin(), order[t].end(),
              [&](int a, int b) { return key[a] != key[b] ? key[a] < key[b] : a < b; });
    std::vector<int> from;
    for (int seed : order[t]) {
      const int slot = static_cast<int>(from.size());
      from.push_back(slots[seed].slot);
      slots[seed].slot = slot;
    }
    store[t].rearrange(from);
    bonds[t].rearrange(from);
  }
  const auto fit = [](auto&... list) { (list.shrink_to_fit(), ...); };
  fit(slots, first, sphere_radius, sphere_mass, labels, groups);
  load_step = 0;
  arranged_at = substeps;
  arranged_seeds = n_seeds();
  divided = false;
}

void Dem::divide() {
  const ContactHistory touching = history();
  std::vector<double> cost(n_seeds(), 0.0);
  for (const ContactHistory::Pair& pair : touching.pairs)
    for (const int sphere : {pair.first, pair.second}) cost[seed_of_sphere(sphere)] += 0.5 * cost_of_contact;
  for (const ContactHistory::OnWall& contact : touching.on_wall)
    cost[seed_of_sphere(contact.sphere)] += cost_of_contact;

  const std::vector<unsigned long long> key = curve_keys(centres());
  std::vector<SeedShare::Block> blocks;
  for (int t = 0; t < static_cast<int>(store.size()); ++t) {
    const double motion = store[t].rigid ? cost_of_body : cost_of_bonded_sphere * store[t].n_spheres();
    unsigned long long reached = 0;  // seeds move: the order in memory counts
    for (std::size_t slot = 0; slot < store[t].seed.size(); ++slot) {
      const int seed = store[t].seed[slot];
      reached = std::max(reached, key[seed]);
      if (slot % lane_width == 0) blocks.push_back({t, static_cast<int>(slot) / lane_width, reached, 0});
      blocks.back().cost += motion + cost[seed];
    }
  }
  park();
  share.divide(store, blocks);
  divided = true;
}

std::vector<Vec3> Dem::centres() const {
  std::vector<Vec3> centre(n_seeds());
  for (int seed = 0; seed < n_seeds(); ++seed) {
    const SeedStore& s = store[slots[seed].store];
    s.positions(slots[seed].slot,
                [&](int i, const Vec3& x) { centre[seed] += (s.model.sphere_mass[i] / s.model.mass) * x; });
  }
  return centre;
}

void Dem::complete_positions() {
  if (share.n_ranks() == 1) return;
  for (int t = 0; t < static_cast<int>(store.size()); ++t) {
    SeedStore& s = store[t];
    if (s.rigid) {
      share.gather(t, s.body, 1);
      continue;
    }
    const std::size_t n = s.n_spheres(), begin = share.begin(t) * n, end = share.end(t) * n;
    std::vector<LaneVec3> x(s.sphere.size());
    for (std::size_t k = begin; k < end; ++k) x[k] = s.sphere[k].position;
    share.gather(t, x, n);
    for (std::size_t k = 0; k < begin; ++k) s.sphere[k].position = x[k];
    for (std::size_t k = end; k < x.size(); ++k) s.sphere[k].position = x[k];
  }
}

void Dem::complete(double time, bool with_forces) {
  check_walls(time);
  const std::size_t n_walls = all_walls.size();
  share.add_up(block_impulse);
  for (std::size_t k = 0; k < block_impulse.size(); ++k) wall_impulse[k % n_walls] += block_impulse[k];
  if (with_forces) {
    std::vector<Vec3> force(block_impulse.size());
    contacts.add_wall_forces(1, static_cast<int>(n_walls), force);
    share.add_up(force);
    wall_force.assign(n_walls, Vec3{});
    for (std::size_t k = 0; k < force.size(); ++k) wall_force[k % n_walls] += force[k];
  }
  std::fill(block_impulse.begin(), block_impulse.end(), Vec3{});
  if (share.n_ranks() == 1) return;

  for (int t = 0; t < static_cast<int>(store.size()); ++t) {
    SeedStore& s = store[t];
    if (s.rigid) {
      share.gather(t, s.body, 1);
      if (with_forces) share.gather(t, s.body_force, 1);
    } else {
      share.gather(t, s.sphere, s.n_spheres());
      if (with_forces) share.gather(t, s.force, s.n_spheres());
      bonds[t].gather(share, t);
    }
  }
  // Of a pair that two ranks know, the owner of the first sub-sphere speaks.
  merged = contacts.history();
  const auto not_own = [&](const ContactHistory::Pair& pair) {
    const int t = numbering.store_of_sphere(pair.first);
    return share.owner(t, (pair.first - numbering.first_sphere[t]) / store[t].n_spheres() / lane_width) !=
           share.rank();
  };
  merged.pairs.erase(std::remove_if(merged.pairs.begin(), merged.pairs.end(), not_own), merged.pairs.end());
  share.concatenate(merged.pairs);
  share.concatenate(merged.on_wall);
  merged.sort();
}

std::string Dem::place_of(int seed) const {
  const SeedState s = seed_state(seed);
  std::ostringstream text;
  text << "seed " << seed;
  if (labels[seed] != seed) text << " (label " << labels[seed] << ")";
  text << " ('" << seed_template(seed).name << "') at (" << s.centre.x << ", " << s.centre.y << ", "
       << s.centre.z << ") m";
  return text.str();
}

void Dem::check_walls(double time) const {
  std::vector<WallFault> faults;
  if (contacts.is_listed() && contacts.fault().sphere >= 0) faults.push_back(contacts.fault());
  share.concatenate(faults);
  if (faults.empty()) return;
  const WallFault& fault = faults.front();
  const int t = numbering.store_of_sphere(fault.sphere);
  const int slot = (fault.sphere - numbering.first_sphere[t]) / store[t].n_spheres();
  std::ostringstream text;
  text << "A seed is passing through wall '" << all_walls[fault.wall].name
       << "': " << place_of(store[t].seed[slot]) << ", not later than t = " << time
       << " s. Reduce the time step, the speed of the wall, or make the wall stiffer.";
  throw RunError(text.str());
}

void Dem::check_state(double time) const {
  const auto is_inside = [&](const Vec3& x) {
    return !bounded ||
           (x.x >= low.x && x.y >= low.y && x.z >= low.z && x.x <= high.x && x.y <= high.y && x.z <= high.z);
  };
  const auto is_number = [](const Vec3& x, const Vec3& v) {
    return std::isfinite(x.x + x.y + x.z + v.x + v.y + v.z);
  };
  std::vector<int> faulty;  // every rank looks at its own seeds
  for (const OwnBlock& own : own_blocks) {
    const SeedStore& s = store[own.store];
    LaneVec3 centre, velocity;
    if (s.rigid) centre = s.body[own.block].position, velocity = s.body[own.block].velocity;
    for (int i = 0; !s.rigid && i < s.n_spheres(); ++i) {
      const double weight = s.model.sphere_mass[i] / s.model.mass;
      centre += weight * s.block(own.block)[i].position;
      velocity += weight * s.block(own.block)[i].velocity;
    }
    const int begin = own.block * lane_width, end = static_cast<int>(s.seed.size());
    for (int slot = begin; slot < std::min(begin + lane_width, end); ++slot) {
      const Vec3 x = centre.get(slot - begin);
      if (!is_number(x, velocity.get(slot - begin)) || !is_inside(x)) faulty.push_back(s.seed[slot]);
    }
  }
  share.concatenate(faulty);
  if (faulty.empty()) return;
  const int seed = *std::min_element(faulty.begin(), faulty.end());
  const SeedState state = seed_state(seed);
  const Vec3& x = state.centre;
  std::ostringstream where;
  where << "seed " << seed << " ('" << seed_template(seed).name << "') at (" << x.x << ", " << x.y << ", "
        << x.z << ") m, t = " << time << " s";
  if (!is_number(x, state.velocity))
    throw RunError("The motion of the seeds failed: not a number in " + where.str() +
                   ". Reduce the time step or look at the forces on this seed.");
  throw RunError("A seed left the domain: " + where.str() +
                 ". Close the domain with walls, enlarge it, or end the run earlier.");
}

}  // namespace seedflow
