// The time step.

#include "seedflow/seeds/dem.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "seedflow/base/error.h"

namespace seedflow {
namespace {

// Substeps after which a long advance() looks whether seeds are to be sorted and divided anew, and whether
// they are still numbers.
constexpr long substeps_between_checks = 1000;

}  // namespace

Dem::Dem(const DemParameters& dem_parameters, MPI_Comm communicator)
    : parameters(dem_parameters), skin(dem_parameters.contacts.skin), share(communicator) {}

void Dem::advance(double duration) {
  if (!(duration > 0)) return;
  const long n = std::max(1L, std::lround(std::ceil(duration / parameters.time_step * (1 - 1e-12))));
  const double step = duration / n;
  if (seeds_at_start < 0) seeds_at_start = next_label;
  if (arrangement_is_due()) arrange();
  if (!divided) divide();
  number();
  if (!forces_known) evaluate_forces(step);
  relax_factors(step);
  begin_impulses(step);
  // Velocity Verlet; the second half kick of one substep and the first of the next are one.
  move(Stage::first, {0.5 * step, step, true, parameters.gravity}, step);
  for (long k = 1; k <= n; ++k) {
    if (k % substeps_between_checks == 0) {
      ghosts.complete(contacts.bodies());
      learn_speed(step);
      complete(now + k * step, false);
      check_state(now + k * step);
      // Impulses of outside loads are booked where a seed stands; steps under such loads are short.
      const bool loaded =
          std::any_of(store.begin(), store.end(), [](const SeedStore& s) { return !s.load.empty(); });
      if (!loaded && arrangement_is_due()) arrange(), divide(), number();
    }
    contact_forces(now + k * step, step);
    if (k < n)
      move(Stage::middle, {step, step, false, parameters.gravity}, step);
    else
      move(Stage::last, {0.5 * step, 0, true, parameters.gravity}, step);
    ++substeps;
  }
  ghosts.complete(contacts.bodies());
  end_impulses(duration);
  now += duration;
  complete(now, true);
  check_state(now);
}

void Dem::evaluate_forces(double step) {
  for (SeedStore& s : store) {
    std::fill(s.force.begin(), s.force.end(), ForceLanes{});
    std::fill(s.body_force.begin(), s.body_force.end(), ForceLanes{});
  }
  park();
  make_lists(now);
  contacts.add_forces(all_walls, placements(now), {0, step});
  for (std::size_t t = 0; t < store.size(); ++t)
    for (int b = share.begin(t); b < share.end(t); ++b) {
      SeedStore& s = store[t];
      if (s.rigid) {
        contacts.take_forces(first_block[t] + b, s.body_force[b]);
      } else {
        contacts.take_forces(first_block[t] + b, s.forces(b));
        bonds[t].add_forces(s.block(b), s.forces(b), b, 0);
      }
    }
  std::vector<Vec3> force(block_impulse.size());
  contacts.add_wall_forces(1, static_cast<int>(all_walls.size()), force);
  share.add_up(force);
  wall_force.assign(all_walls.size(), Vec3{});
  for (std::size_t k = 0; k < force.size(); ++k) wall_force[k % all_walls.size()] += force[k];
  forces_known = true;
}

void Dem::contact_forces(double time, double step) {
  ghosts.finish(contacts.bodies());
  if (lists_are_outdated(time, step)) {
    learn_speed(step);
    make_lists(time);
  }
  contacts.add_forces(all_walls, placements(time), step);
}

bool Dem::lists_are_outdated(double time, double step) {
  if (!contacts.is_listed()) return true;
  travel.add_of_walls(wall_speed(time) * step);
  if (travel.may_exceed()) learn_speed(step);
  return travel.exceeds(store, share) || skin.is_stale(static_cast<double>(substeps - searched_at));
}

void Dem::learn_speed(double step) {
  if (!speed.is_pending()) return;
  largest_speed = speed.finish();
  travel.add(largest_speed * step);
}

void Dem::move(Stage stage, const MotionStep& motion, double bond_step) {
  fastest = FastestSpeeds{};
  int largest = 0;
  for (const SeedStore& s : store)
    if (!s.rigid) largest = std::max(largest, s.n_spheres());
  scratch.assign(largest, ForceLanes{});
  // What other ranks wait for goes first and travels while the rest is moved.
  for (std::size_t k = 0; k < n_awaited; ++k) move_block(stage, motion, bond_step, k);
  if (motion.drift > 0 && contacts.is_listed()) ghosts.start(share, contacts.bodies());
  for (std::size_t k = n_awaited; k < own_blocks.size(); ++k) move_block(stage, motion, bond_step, k);

  if (speed.is_pending()) {
    learn_speed(bond_step);
    if (travel.exceeded(store, share)) {
      ghosts.complete(contacts.bodies());
      std::ostringstream text;
      text << "Seeds were thrown apart: at t = " << now << " s or soon after the fastest sub-sphere came to "
           << largest_speed
           << " m/s within one substep, so that a contact between seeds of two ranks may have been missed. "
              "Reduce the time step, or make the skin of the contact lists thicker.";
      throw RunError(text.str());
    }
  }
  if (motion.drift > 0) speed.start(share, fastest.bound());
  if (stage == Stage::first || share.n_ranks() == 1) learn_speed(bond_step);
  const int n_walls = static_cast<int>(all_walls.size());
  if (stage == Stage::first)
    for (int w = 0; w < n_walls; ++w) wall_impulse[w] += motion.kick * wall_force[w];
  else
    contacts.add_wall_forces(motion.kick, n_walls, block_impulse);
}

void Dem::move_block(Stage stage, const MotionStep& motion, double bond_step, std::size_t k) {
  const int t = own_blocks[k].store, b = own_blocks[k].block;
  SeedStore& s = store[t];
  const int block = first_block[t] + b;
  if (s.rigid) {
    ForceLanes forces = stage == Stage::first ? s.body_force[b] : ForceLanes{};
    if (stage != Stage::first) contacts.take_forces(block, forces);
    if (stage == Stage::last) s.body_force[b] = forces;
    move_rigid(s, b, forces, motion, fastest);
  } else {
    // Forces are kept only from the last substep of one advance() to the first of the next.
    ForceLanes* const forces = stage == Stage::middle ? scratch.data() : s.forces(b);
    if (stage != Stage::first) {
      contacts.take_forces(block, forces);
      // Bonds and motion of a block follow each other while the block is in the cache.
      NextBlock next;
      if (k + 1 < own_blocks.size() && own_blocks[k + 1].store == t)
        next.spheres = s.block(own_blocks[k + 1].block);
      bonds[t].add_forces(s.block(b), forces, b, bond_step, next);
    }
    move_bonded(s, b, forces, motion, fastest);
  }
  if (motion.drift > 0 && contacts.is_listed()) contacts.place(block, s, b);
}

}  // namespace seedflow
