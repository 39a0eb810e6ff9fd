// Who touches whom.

#include <algorithm>
#include <set>
#include <tuple>

#include "seedflow/seeds/dem.h"

namespace seedflow {

ContactNetwork Dem::contact_network() const {
  ContactNetwork network;
  const auto begin = [&](int sphere) {
    NetworkContact c;
    const int seed = seed_of_sphere(sphere);
    c.label_a = labels[seed], c.sphere_a = sphere - first[seed];
    return c;
  };
  const ContactHistory all = history();
  for (const ContactHistory::Pair& pair : all.pairs) {
    if (pair.memory[3] == 0) continue;
    NetworkContact c = begin(pair.first);
    const int other = seed_of_sphere(pair.second);
    c.label_b = labels[other], c.sphere_b = pair.second - first[other];
    c.normal_force = pair.memory[3];
    network.push_back(c);
  }
  for (const ContactHistory::OnWall& contact : all.on_wall) {
    if (contact.memory[3] == 0) continue;
    NetworkContact c = begin(contact.sphere);
    c.wall = contact.wall, c.feature = contact.feature;
    c.normal_force = contact.memory[3];
    network.push_back(c);
  }
  const auto key = [](const NetworkContact& c) {
    return std::make_tuple(c.label_a, c.sphere_a, c.label_b, c.sphere_b, c.wall, c.feature);
  };
  std::sort(network.begin(), network.end(),
            [&](const NetworkContact& a, const NetworkContact& b) { return key(a) < key(b); });
  return network;
}

int Dem::n_contacts() const {
  const ContactHistory all = history();
  const auto acts = [](const auto& contact) { return contact.memory[3] != 0; };
  return static_cast<int>(std::count_if(all.pairs.begin(), all.pairs.end(), acts) +
                          std::count_if(all.on_wall.begin(), all.on_wall.end(), acts));
}

std::vector<int> Dem::coordination_numbers() const {
  std::set<std::tuple<long, long, int>> touching;
  for (const NetworkContact& c : contact_network()) touching.insert({c.label_a, c.label_b, c.wall});
  std::vector<int> number(n_seeds(), 0);
  const auto seed_of = [&](long label) {
    return std::lower_bound(labels.begin(), labels.end(), label) - labels.begin();
  };
  for (const auto& [a, b, wall] : touching) {
    ++number[seed_of(a)];
    if (b >= 0) ++number[seed_of(b)];
  }
  return number;
}

}  // namespace seedflow
