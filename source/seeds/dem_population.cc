// Seeds that come and go.

#include <algorithm>

#include "seedflow/base/error.h"
#include "seedflow/seeds/dem.h"

namespace seedflow {

int Dem::add_seed(int seed_template, const Vec3& centre, const Quaternion& orientation, const Vec3& velocity,
                  const Vec3& spin) {
  if (seed_template < 0 || seed_template >= static_cast<int>(store.size()))
    throw InputError("There is no seed template number " + std::to_string(seed_template) + ".");
  const int number = n_seeds();
  SeedStore& s = store[seed_template];
  const int slot = s.add(number, centre, normalized(orientation), velocity, spin);
  if (slot % lane_width == 0) bonds[seed_template].add_block();
  slots.push_back({seed_template, slot});
  labels.push_back(next_label++);
  groups.push_back(0);
  number_spheres();
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
  std::vector<int> new_number(n_spheres(), -1);
  int n_kept = 0, sphere = 0;
  for (int seed = 0; seed < n_seeds(); ++seed) {
    if (gone[seed]) continue;
    for (int i = first[seed]; i < first[seed + 1]; ++i) new_number[i] = sphere++;
    slots[n_kept] = slots[seed];
    store[slots[seed].store].seed[slots[seed].slot] = n_kept;
    labels[n_kept] = labels[seed];
    groups[n_kept] = groups[seed];
    ++n_kept;
  }
  std::vector<std::vector<int>> from(store.size());
  slots.resize(n_kept), labels.resize(n_kept), groups.resize(n_kept);
  for (Slot& slot : slots) {
    from[slot.store].push_back(slot.slot);
    slot.slot = static_cast<int>(from[slot.store].size()) - 1;
  }
  for (std::size_t t = 0; t < store.size(); ++t) {
    store[t].rearrange(from[t]);
    store[t].load.clear();
    store[t].rigid_load.clear();
    bonds[t].rearrange(from[t]);
  }
  contacts.renumber(new_number);
  number_spheres();
}

void Dem::number_spheres() {
  first.assign(1, 0);
  sphere_radius.clear(), sphere_mass.clear();
  for (const Slot& slot : slots) {
    const SeedTemplate& model = store[slot.store].model;
    first.push_back(first.back() + model.n_spheres());
    sphere_radius.insert(sphere_radius.end(), model.radius.begin(), model.radius.end());
    sphere_mass.insert(sphere_mass.end(), model.sphere_mass.begin(), model.sphere_mass.end());
  }
  forces_known = false;
  load_step = 0;
  address.clear();
}

}  // namespace seedflow
