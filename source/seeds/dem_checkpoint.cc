// Saving and loading a Dem.

#include "seedflow/base/binary.h"
#include "seedflow/seeds/dem.h"

namespace seedflow {

void Dem::save(std::ostream& out) const {
  write_binary(out, lane_width);
  write_binary(out, seeds_at_start);
  write_binary(out, static_cast<int>(all_walls.size()));
  for (const SeedStore& s : store) write_binary(out, s.n_spheres());
  write_binary(out, labels);
  write_binary(out, groups);
  write_binary(out, slots);
  write_binary(out, next_label);
  write_binary(out, now);
  write_binary(out, substeps);
  write_binary(out, arranged_at);
  write_binary(out, arranged_seeds);
  write_binary(out, largest_speed);
  write_binary(out, forces_known);
  skin.save(out);
  write_binary(out, wall_impulse);
  write_binary(out, wall_force);
  for (const Wall& w : all_walls) write_binary(out, w.active);
  const ContactHistory all = history();
  write_binary(out, all.pairs);
  write_binary(out, all.on_wall);
  for (std::size_t t = 0; t < store.size(); ++t) {
    const SeedStore& s = store[t];
    write_binary(out, s.seed);
    write_binary(out, s.occupied);
    write_binary(out, s.sphere);
    write_binary(out, s.force);
    write_binary(out, s.body);
    write_binary(out, s.body_force);
    write_binary(out, s.load);
    bonds[t].save(out);
  }
}

void Dem::load(std::istream& in) {
  int width = 0, n_walls = 0;
  long began_with = 0;
  read_binary(in, width);
  if (width != lane_width)
    throw RunError("The saved state was made by a build with " + std::to_string(width) +
                   " numbers in a SIMD register, this build has " + std::to_string(lane_width) +
                   ". Resume on a machine of the same kind, or start again.");
  read_binary(in, began_with);
  const long own_seeds = seeds_at_start >= 0 ? seeds_at_start : next_label;
  if (began_with >= 0 && began_with != own_seeds)
    throw RunError("The saved state began with " + std::to_string(began_with) + " seeds, this set-up with " +
                   std::to_string(own_seeds) + ". Resume with the input the state was made with.");
  read_binary(in, n_walls);
  if (n_walls != static_cast<int>(all_walls.size()))
    throw RunError("The saved state has " + std::to_string(n_walls) + " walls, this set-up has " +
                   std::to_string(all_walls.size()) + ". Resume with the input the state was made with.");
  for (const SeedStore& s : store) {
    int n = 0;
    read_binary(in, n);
    if (n != s.n_spheres())
      throw RunError("The saved state has a template of " + std::to_string(n) + " sub-spheres where '" +
                     s.model.name + "' has " + std::to_string(s.n_spheres()) +
                     ". Resume with the input the state was made with.");
  }
  seeds_at_start = began_with;
  read_binary(in, labels);
  read_binary(in, groups);
  read_binary(in, slots);
  read_binary(in, next_label);
  read_binary(in, now);
  read_binary(in, substeps);
  read_binary(in, arranged_at);
  read_binary(in, arranged_seeds);
  read_binary(in, largest_speed);
  read_binary(in, forces_known);
  skin.load(in);
  read_binary(in, wall_impulse);
  read_binary(in, wall_force);
  for (Wall& w : all_walls) read_binary(in, w.active);
  contacts.forget();
  read_binary(in, parked.pairs);
  read_binary(in, parked.on_wall);
  for (std::size_t t = 0; t < store.size(); ++t) {
    SeedStore& s = store[t];
    read_binary(in, s.seed);
    read_binary(in, s.occupied);
    read_binary(in, s.sphere);
    read_binary(in, s.force);
    read_binary(in, s.body);
    read_binary(in, s.body_force);
    read_binary(in, s.load);
    bonds[t].load(in);
  }
  first.assign(1, 0);
  sphere_radius.clear(), sphere_mass.clear();
  for (const Slot& slot : slots) {
    const SeedTemplate& model = store[slot.store].model;
    first.push_back(first.back() + model.n_spheres());
    sphere_radius.insert(sphere_radius.end(), model.radius.begin(), model.radius.end());
    sphere_mass.insert(sphere_mass.end(), model.sphere_mass.begin(), model.sphere_mass.end());
  }
  load_step = 0;
  divided = false;
}

}  // namespace seedflow
