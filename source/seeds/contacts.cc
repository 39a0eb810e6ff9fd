#include "seedflow/seeds/contacts.h"

#include <algorithm>

#include "seedflow/base/parameters.h"

namespace seedflow {
namespace {

// Numbers 0, 1, ... for keys in the order in which they come.
class Groups {
 public:
  int number(int a, int b) {
    if (a != present) present = a, known.clear();
    for (const auto& [key, number] : known)
      if (key == b) return number;
    known.push_back({b, count});
    return count++;
  }

 private:
  int present = -1, count = 0;
  std::vector<std::pair<int, int>> known;
};

int seed_of(const Contacts::Surroundings& now, int sphere) {
  const Numbering& n = now.cloud.numbering;
  const int t = n.store_of_sphere(sphere);
  return n.first_seed[t] + (sphere - n.first_sphere[t]) / now.stores[t].n_spheres();
}

int material_of(const Contacts::Surroundings& now, int sphere) {
  return now.stores[now.cloud.numbering.store_of_sphere(sphere)].material;
}

std::vector<WallCandidate> candidates_of(const Contacts::Surroundings& now, double skin) {
  std::vector<WallCandidate> found;
  const Numbering& n = now.cloud.numbering;
  for (std::size_t t = 0; t < now.stores.size(); ++t)
    for (int seed = n.first_seed[t]; seed < n.first_seed[t + 1]; ++seed) {
      if (!now.own[seed]) continue;
      const Ball& ball = now.cloud.ball[seed];
      const int n_spheres = now.stores[t].n_spheres();
      const int begin = n.first_sphere[t] + (seed - n.first_seed[t]) * n_spheres;
      const std::size_t first_found = found.size();
      for (std::size_t w = 0; w < now.walls.size(); ++w) {
        if (!now.walls[w].active ||
            !may_touch(now.walls[w], now.placements[w], ball.centre, ball.radius + skin))
          continue;
        now.cloud.take(now.stores, seed);
        for (int i = 0; i < n_spheres; ++i)
          if (may_touch(now.walls[w], now.placements[w], now.cloud.position(begin + i),
                        now.stores[t].model.radius[i] + skin))
            found.push_back({begin + i, static_cast<int>(w)});
      }
      std::sort(found.begin() + first_found, found.end(), [](const WallCandidate& a, const WallCandidate& b) {
        return a.sphere != b.sphere ? a.sphere < b.sphere : a.wall < b.wall;
      });
    }
  return found;
}

// What this rank is to count of the lists: pairs whose first seed is its own, its own sub-spheres.
ListSizes sizes_of(const Contacts::Surroundings& now, const FoundPairs& found,
                   const std::vector<WallCandidate>& at_walls, double inner_gap) {
  ListSizes sizes;
  const Numbering& n = now.cloud.numbering;
  std::vector<char> listed(n.n_spheres(), 0);  // 1: within the skin, 3: also within half of it
  const auto mark = [&](int sphere, bool close) { listed[sphere] |= close ? 3 : 1; };
  for (std::size_t k = 0; k < found.pair.size(); ++k) {
    mark(found.pair[k].first, found.close[k]);
    mark(found.pair[k].second, found.close[k]);
  }
  for (const WallCandidate& c : at_walls) {
    const int t = n.store_of_sphere(c.sphere);
    const double radius =
        now.stores[t].model.radius[(c.sphere - n.first_sphere[t]) % now.stores[t].n_spheres()];
    const bool close = may_touch(now.walls[c.wall], now.placements[c.wall], now.cloud.position(c.sphere),
                                 radius + inner_gap);
    mark(c.sphere, close);
    sizes.whole.at_walls += 1, sizes.half.at_walls += close;
  }
  for (std::size_t t = 0; t < now.stores.size(); ++t)
    for (int seed = n.first_seed[t]; seed < n.first_seed[t + 1]; ++seed) {
      if (!now.own[seed]) continue;
      for (int k = found.begin[seed]; k < found.begin[seed + 1]; ++k)
        sizes.whole.pairs += 1, sizes.half.pairs += found.close[k];
      const int begin = now.cloud.first_sphere(now.stores[t], t, seed - n.first_seed[t]);
      for (int k = begin; k < begin + now.stores[t].n_spheres(); ++k)
        sizes.whole.spheres += listed[k] & 1, sizes.half.spheres += listed[k] >> 1;
    }
  return sizes;
}

}  // namespace

void ContactParameters::declare(Parameters& p) {
  const auto section = p.section("Contacts", "Contacts of seeds with each other and with walls.");
  p.number("Skin", skin, "m", Range::non_negative(),
           "Contact lists hold pairs of sub-spheres with gaps below this; results do not depend on it. 0: "
           "chosen while running, so that lists and searches together cost least.");
  p.flag("Normalise multiple contacts", normalise,
         "Let n simultaneous sub-sphere contacts between the same two seeds, or a seed and a wall, act with "
         "1/n of their stiffness and damping each.");
}

void Contacts::set_law(int a, int b, const ContactLaw& contact_law) {
  const std::size_t n = std::max<std::size_t>(law_number.size(), std::max(a, b) + 1);
  law_number.resize(n);
  for (auto& row : law_number) row.resize(n, -1);
  if (law_number[a][b] < 0) {
    law_number[a][b] = law_number[b][a] = static_cast<int>(laws.size());
    laws.emplace_back();
  }
  laws[law_number[a][b]] = contact_law;
}

ListSizes Contacts::search(const Surroundings& now, double skin, bool normalise,
                           const ContactHistory& history) {
  const Numbering& numbering = now.cloud.numbering;
  listed_skin = skin;
  double largest = 0, reach = 0;
  for (const SeedStore& s : now.stores)
    for (double r : s.model.radius) largest = std::max(largest, r);
  for (const ContactLaw& l : laws) reach = std::max(reach, l.reach(largest));
  const double inner_gap = 0.5 * skin + reach;
  const FoundPairs found = pairs_within(now.stores, now.cloud, skin + reach, inner_gap, now.own);
  const std::vector<WallCandidate> at_walls = candidates_of(now, skin + reach);

  std::vector<int> entry_of(numbering.n_spheres(), -1);
  for (const SpherePair& pair : found.pair) entry_of[pair.first] = entry_of[pair.second] = 0;
  for (const WallCandidate& c : at_walls) entry_of[c.sphere] = 0;
  make_entries(now, entry_of);
  list_pairs(now, normalise, history, found, entry_of);
  list_walls(now, normalise, history, at_walls, entry_of);
  return sizes_of(now, found, at_walls, inner_gap);
}

void Contacts::make_entries(const Surroundings& now, std::vector<int>& entry_of) {
  const std::size_t n_entries = std::count(entry_of.begin(), entry_of.end(), 0);
  // Memory that fits about is used again.
  const auto empty = [&](auto& v) {
    if (v.capacity() > n_entries + n_entries / 4) std::decay_t<decltype(v)>().swap(v);
    v.clear(), v.reserve(n_entries);
  };
  empty(all_bodies.sphere), empty(all_bodies.body), empty(all_bodies.state), empty(places);
  first_entry.clear();
  all_bodies.motion.clear();
  for (std::size_t t = 0; t < now.stores.size(); ++t) {
    const SeedStore& s = now.stores[t];
    const int n = s.n_spheres();
    const double inertia = std::min({s.model.inertia.x, s.model.inertia.y, s.model.inertia.z});
    for (int slot = 0; slot < static_cast<int>(s.seed.size()); ++slot) {
      if (slot % lane_width == 0) first_entry.push_back(static_cast<int>(places.size()));
      const int begin = now.cloud.first_sphere(s, static_cast<int>(t), slot);
      bool has_body = false;
      for (int i = 0; i < n; ++i) {
        if (entry_of[begin + i] < 0) continue;
        entry_of[begin + i] = static_cast<int>(places.size());
        places.push_back({i, slot % lane_width});
        all_bodies.sphere.push_back(begin + i);
        all_bodies.state.push_back({{0, 0, 0, s.model.radius[i]}});
        if (!s.rigid || !has_body) {
          ContactMotion& motion = all_bodies.motion.emplace_back();
          motion[3] = s.rigid ? s.model.mass : s.model.sphere_mass[i];
          motion[7] = s.rigid ? inertia : s.model.sphere_inertia[i];
          has_body = true;
        }
        all_bodies.body.push_back(static_cast<int>(all_bodies.motion.size()) - 1);
      }
    }
  }
  first_entry.push_back(static_cast<int>(places.size()));
  const auto turns_about_another_point = [](const SeedStore& s) {
    return s.rigid && s.n_spheres() > 1 && !s.seed.empty();
  };
  // Rare laws have one kernel, that with levers.
  const auto is_rare = [](const ContactLaw& l) { return l.cohesion != Cohesion::none || l.partial_slip > 0; };
  const bool levers = std::any_of(now.stores.begin(), now.stores.end(), turns_about_another_point) ||
                      std::any_of(laws.begin(), laws.end(), is_rare);
  const std::size_t n_bodies = all_bodies.motion.size();
  if (all_bodies.motion.capacity() > n_bodies + n_bodies / 4) all_bodies.motion.shrink_to_fit();
  std::vector<ContactSum>(n_bodies).swap(all_bodies.sum);
  std::vector<HalfLine>(levers ? n_bodies : 0).swap(all_bodies.centre);
}

void Contacts::list_pairs(const Surroundings& now, bool normalise, const ContactHistory& history,
                          const FoundPairs& found, const std::vector<int>& entry_of) {
  const std::size_t n = found.pair.size();
  std::vector<int> law(laws.size() > 1 ? n : 0), group(normalise ? n : 0);
  Groups groups;
  for (std::size_t k = 0; k < law.size(); ++k)
    law[k] = law_number[material_of(now, found.pair[k].first)][material_of(now, found.pair[k].second)];
  for (std::size_t k = 0; k < group.size(); ++k)
    group[k] = groups.number(seed_of(now, found.pair[k].first), seed_of(now, found.pair[k].second));
  pairs.set(found.pair, law, group, entry_of, laws, all_bodies, history);
}

void Contacts::list_walls(const Surroundings& now, bool normalise, const ContactHistory& history,
                          const std::vector<WallCandidate>& found, const std::vector<int>& entry_of) {
  const Numbering& numbering = now.cloud.numbering;
  std::vector<int> law(found.size()), group(normalise ? found.size() : 0), block(found.size());
  Groups groups;
  for (std::size_t k = 0; k < found.size(); ++k) {
    const int t = numbering.store_of_sphere(found[k].sphere), seed = seed_of(now, found[k].sphere);
    law[k] = law_number[now.stores[t].material][now.walls[found[k].wall].material];
    block[k] = now.first_block[t] + (seed - numbering.first_seed[t]) / lane_width;
    if (normalise) group[k] = groups.number(seed, found[k].wall);
  }
  on_walls.set(found, law, group, block, entry_of, laws, all_bodies, history);
}

ContactHistory Contacts::history() const {
  ContactHistory h;
  pairs.collect(all_bodies, h.pairs);
  on_walls.collect(all_bodies, h.on_wall);
  h.sort();
  return h;
}

std::size_t Contacts::bytes() const {
  return pairs.bytes() + on_walls.bytes() + all_bodies.bytes() + places.capacity() * sizeof(Place) +
         first_entry.capacity() * sizeof(int);
}

}  // namespace seedflow
