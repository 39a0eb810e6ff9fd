// When and from what the contact lists are made.

#include <algorithm>

#include "seedflow/seeds/dem.h"

namespace seedflow {

std::vector<Placement> Dem::placements(double time) const {
  std::vector<Placement> result;
  result.reserve(all_walls.size());
  for (const Wall& w : all_walls) result.push_back(seedflow::placement(w, time));
  return result;
}

double Dem::wall_speed(double time) const {
  double speed = 0;
  for (const Wall& w : all_walls)
    if (w.active) speed = std::max(speed, seedflow::largest_speed(w, time, lowest, highest));
  return speed;
}

void Dem::make_lists(double time) {
  complete_positions();
  SeedCloud cloud(store);
  std::vector<char> own(numbering.n_seeds(), 0);
  for (std::size_t t = 0; t < store.size(); ++t) {
    const int n = static_cast<int>(store[t].seed.size());
    std::fill(own.begin() + numbering.first_seed[t] + std::min(n, share.begin(t) * lane_width),
              own.begin() + numbering.first_seed[t] + std::min(n, share.end(t) * lane_width), 1);
  }
  lowest = {1e300, 1e300, 1e300}, highest = {-1e300, -1e300, -1e300};
  for (const Ball& ball : cloud.ball)
    for (int c = 0; c < 3; ++c) {
      lowest[c] = std::min(lowest[c], ball.centre[c] - ball.radius);
      highest[c] = std::max(highest[c], ball.centre[c] + ball.radius);
    }
  ContactHistory known;
  if (contacts.is_listed()) {
    skin.moved(travel.way(store, share), std::max(1.0, static_cast<double>(substeps - searched_at)));
    known = contacts.history();
  } else {
    known = std::move(parked);
    known.renumber(sphere_numbers());
    parked = {};
  }
  const std::vector<Placement> place = placements(time);
  double smallest_sphere = 1e300, smallest_seed = 1e300;
  for (const SeedStore& s : store) {
    if (s.seed.empty()) continue;
    smallest_sphere =
        std::min(smallest_sphere, *std::min_element(s.model.radius.begin(), s.model.radius.end()));
    smallest_seed = std::min(smallest_seed, s.model.bounding_radius);
  }
  ListSizes sizes =
      contacts.search({store, cloud, own, first_block, all_walls, place},
                      skin.begin(smallest_sphere, smallest_seed), parameters.contacts.normalise, known);
  share.add_up(sizes);
  skin.found(sizes, n_seeds(), n_spheres());
  searched_at = substeps;
  ++searches;
  for (std::size_t t = 0; t < store.size(); ++t)
    for (int b = share.begin(t); b < share.end(t); ++b) contacts.place(first_block[t] + b, store[t], b);
  ghosts.set(share, numbering, store, contacts.bodies(), contacts.pair_list());
  order_blocks();
  ghosts.start(share, contacts.bodies());
  ghosts.finish(contacts.bodies());
  travel.begin(store, share, contacts.skin());
}

void Dem::order_blocks() {
  std::vector<char> sent(contacts.is_listed() ? contacts.bodies().sphere.size() : 0, 0);
  if (contacts.is_listed()) ghosts.mark_sent(sent);
  own_blocks.clear();
  for (int t = 0; t < static_cast<int>(store.size()); ++t)
    for (int b = share.begin(t); b < share.end(t); ++b) own_blocks.push_back({t, b});
  const auto is_awaited = [&](const OwnBlock& own) {
    const int block = first_block[own.store] + own.block;
    return !sent.empty() && std::any_of(sent.begin() + contacts.entries(block),
                                        sent.begin() + contacts.entries(block + 1), [](char c) { return c; });
  };
  n_awaited = std::stable_partition(own_blocks.begin(), own_blocks.end(), is_awaited) - own_blocks.begin();
}

std::vector<int> Dem::sphere_numbers() const {
  const Numbering present(store);
  std::vector<int> number;
  number.reserve(n_spheres());
  for (const Slot& slot : slots) {
    const int n = store[slot.store].n_spheres();
    for (int i = 0; i < n; ++i) number.push_back(present.first_sphere[slot.store] + slot.slot * n + i);
  }
  return number;
}

ContactHistory Dem::history() const {
  if (!contacts.is_listed()) return parked;
  ContactHistory all = share.n_ranks() > 1 ? merged : contacts.history();
  const std::vector<int> number = sphere_numbers();
  std::vector<int> users_number(number.size());
  for (std::size_t k = 0; k < number.size(); ++k) users_number[number[k]] = static_cast<int>(k);
  all.renumber(users_number);
  return all;
}

void Dem::park() {
  if (!contacts.is_listed()) return;
  parked = history();
  contacts.forget();
}

}  // namespace seedflow
