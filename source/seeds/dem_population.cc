// Seeds that come and go.

#include <algorithm>

#include "seedflow/base/error.h"
#include "seedflow/seeds/dem.h"

namespace seedflow {

int Dem::add_seed(int seed_template, const Vec3& centre, const Quaternion& orientation, const Vec3& velocity,
                  const Vec3& spin) {
  if (seed_template < 0 || seed_template >= static_cast<int>(store.size()))
    throw InputError("There is no seed template number " + std::to_string(seed_template) + ".");
  park();
  const int number = n_seeds();
  SeedStore& s = store[seed_template];
  const int slot = s.add(number, centre, normalized(orientation), velocity, spin);
  if (slot % lane_width == 0) bonds[seed_template].add_block();
  slots.push_back({seed_template, slot});
  labels.push_back(next_label++);
  groups.push_back(0);
  first.push_back(first.back() + s.n_spheres());
  sphere_radius.insert(sphere_radius.end(), s.model.radius.begin(), s.model.radius.end());
  sphere_mass.insert(sphere_mass.end(), s.model.sphere_mass.begin(), s.model.sphere_mass.end());
  load_step = 0;
  return number;
}

void Dem::remove_seeds(const std::vector<int>& seeds) {
  if (seeds.empty()) return;
  std::vector<char> gone(n_seeds(), 0);
  for (int seed : seeds) {
    if (seed < 0 || seed >= n_seeds())
      throw InputError("There is no seed number " + std::to_string(seed) + " to remove.");
    gone[seed] = 1;
  }
  park();
  std::vector<int> new_number(n_spheres(), -1);
  std::vector<std::vector<int>> from(store.size());
  int n_kept = 0, sphere = 0;
  for (int seed = 0; seed < n_seeds(); ++seed) {
    if (gone[seed]) continue;
    for (int i = first[seed]; i < first[seed + 1]; ++i, ++sphere) {
      new_number[i] = sphere;
      sphere_radius[sphere] = sphere_radius[i], sphere_mass[sphere] = sphere_mass[i];
    }
    slots[n_kept] = slots[seed];
    store[slots[seed].store].seed[slots[seed].slot] = n_kept;
    from[slots[seed].store].push_back(slots[seed].slot);
    labels[n_kept] = labels[seed], groups[n_kept] = groups[seed];
    first[n_kept + 1] = sphere;
    ++n_kept;
  }
  slots.resize(n_kept), labels.resize(n_kept), groups.resize(n_kept), first.resize(n_kept + 1);
  sphere_radius.resize(sphere), sphere_mass.resize(sphere);
  for (std::size_t t = 0; t < store.size(); ++t) {
    std::sort(from[t].begin(), from[t].end());
    store[t].load.clear();
    store[t].rearrange(from[t]);
    bonds[t].rearrange(from[t]);
    for (std::size_t slot = 0; slot < from[t].size(); ++slot) slots[store[t].seed[slot]].slot = slot;
  }
  parked.renumber(new_number);
  forces_known = false;  // the neighbours' hold what the removed seeds pressed with
  arranged_at = -1;
}

}  // namespace seedflow
