// What acts on the seeds from outside.

#include <algorithm>
#include <cmath>

#include "seedflow/base/error.h"
#include "seedflow/seeds/dem.h"
#include "seedflow/seeds/rigid_load.h"

namespace seedflow {

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
  for (SeedStore& s : store) s.load.resize(static_cast<std::size_t>(s.n_blocks()) * s.n_spheres());
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
  for (std::size_t t = 0; t < store.size(); ++t) {
    SeedStore& s = store[t];
    if (s.rigid || s.load.empty()) continue;
    for (int b = share.begin(t); b < share.end(t); ++b)
      for (int i = 0; i < s.n_spheres(); ++i) {
        LoadLanes& l = s.loads(b)[i];
        for (int lane = 0; lane < lane_width; ++lane) {
          const double z = l.drag[lane] * step / (s.model.sphere_mass[i] + l.added_mass[lane]);
          l.relaxed_full[lane] = relaxed(z);
          l.relaxed_half[lane] = relaxed(0.5 * z);
        }
      }
  }
  load_step = step;
}

void Dem::begin_impulses(double step) {
  for (std::size_t t = 0; t < store.size(); ++t) {
    SeedStore& s = store[t];
    for (LoadLanes& l : s.load) l.impulse = LaneVec3{};
    s.rigid_load.resize(s.rigid && !s.load.empty() ? s.seed.size() : 0);
    const std::size_t end = std::min<std::size_t>(share.end(t) * lane_width, s.rigid_load.size());
    for (std::size_t slot = share.begin(t) * lane_width; slot < end; ++slot)
      s.rigid_load[slot] = reduce_loads(s.model, s.loads(slot / lane_width), slot % lane_width, step);
  }
}

void Dem::end_impulses(double duration) {
  for (std::size_t t = 0; t < store.size(); ++t) {
    SeedStore& s = store[t];
    if (s.load.empty()) continue;
    const std::size_t end = std::min<std::size_t>(share.end(t) * lane_width, s.rigid_load.size());
    for (std::size_t slot = share.begin(t) * lane_width; slot < end; ++slot)
      spread_impulses(s.rigid_load[slot], s.model, s.loads(slot / lane_width), slot % lane_width, duration);
    if (share.n_ranks() == 1) continue;
    std::vector<LaneVec3> impulse(s.load.size());
    const std::size_t n = s.n_spheres(), first_own = share.begin(t) * n, last_own = share.end(t) * n;
    for (std::size_t k = first_own; k < last_own; ++k) impulse[k] = s.load[k].impulse;
    share.gather(t, impulse, n);
    for (std::size_t k = 0; k < impulse.size(); ++k) s.load[k].impulse = impulse[k];
  }
}

}  // namespace seedflow
