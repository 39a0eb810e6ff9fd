#include "seedflow/seeds/feeder.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <sstream>
#include <unordered_map>

#include "seedflow/base/binary.h"
#include "seedflow/base/error.h"
#include "seedflow/seeds/dem.h"
#include "seedflow/seeds/packing_random.h"

namespace seedflow {

/// The bounding spheres that are there, in cells as large as the largest of them.
class Feeder::Room {
 public:
  Room(const Dem& dem, double largest) : dem(dem), walls(dem.walls()) {
    for (int s = 0; s < dem.n_seeds(); ++s) largest = std::max(largest, dem.seed_template(s).bounding_radius);
    size = 2 * largest;
    for (int s = 0; s < dem.n_seeds(); ++s)
      add(dem.seed_state(s).centre, dem.seed_template(s).bounding_radius);
    for (const Wall& wall : walls) placements.push_back(placement(wall, dem.time()));
  }

  void add(const Vec3& x, double radius) { cells[key(x, 0, 0, 0)].push_back({x, radius}); }

  /// What stands in the way: "" if nothing.
  std::string obstacle(const Vec3& x, double radius) const {
    for (int i = -1; i <= 1; ++i)
      for (int j = -1; j <= 1; ++j)
        for (int k = -1; k <= 1; ++k) {
          const auto cell = cells.find(key(x, i, j, k));
          if (cell == cells.end()) continue;
          for (const Ball& b : cell->second)
            if (norm_square(b.centre - x) < (b.radius + radius) * (b.radius + radius)) return "another seed";
        }
    for (std::size_t w = 0; w < walls.size(); ++w)
      if (may_touch(walls[w], placements[w], x, radius)) {
        std::vector<WallPoint> points;
        contacts_near(walls[w], placements[w], x, radius, points);
        if (!points.empty()) return "wall '" + walls[w].name + "'";
      }
    return "";
  }

 private:
  struct Ball {
    Vec3 centre;
    double radius;
  };
  std::uint64_t key(const Vec3& x, int i, int j, int k) const {
    const auto cell = [&](double a, int shift) {
      return static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(a / size)) + shift + (1 << 20)) &
             0x1fffff;
    };
    return cell(x.x, i) << 42 | cell(x.y, j) << 21 | cell(x.z, k);
  }
  const Dem& dem;
  const std::vector<Wall>& walls;
  std::vector<Placement> placements;
  double size;
  std::unordered_map<std::uint64_t, std::vector<Ball>> cells;
};

namespace {

// All orientations alike likely (Shoemake 1992, doi 10.1016/B978-0-08-050755-2.50036-1).
Quaternion random_orientation(PortableRandom& random) {
  const double u = random.uniform(), a = 2 * M_PI * random.uniform(), b = 2 * M_PI * random.uniform();
  return {std::sqrt(u) * std::cos(b),
          {std::sqrt(1 - u) * std::sin(a), std::sqrt(1 - u) * std::cos(a), std::sqrt(u) * std::sin(b)}};
}

// The member of a list of shares that a number in [0, 1) stands for.
template <class Share>
int choose(int n, const Share& share, double number) {
  double sum = 0;
  for (int i = 0; i < n; ++i) sum += share(i);
  double passed = 0;
  for (int i = 0; i + 1 < n; ++i)
    if (number * sum < (passed += share(i))) return i;
  return n - 1;
}

std::string place_text(const Vec3& x) {
  std::ostringstream text;
  text << "(" << x.x << ", " << x.y << ", " << x.z << ") m";
  return text.str();
}

// A number of streams for places that no property of a seed uses.
constexpr std::uint64_t place_streams = std::uint64_t(1) << 40;

}  // namespace

Feeder::Feeder(FeederParameters p) : parameters(std::move(p)) {
  const std::string name = "Feeder '" + parameters.name + "'";
  if (parameters.kinds.empty()) throw InputError(name + " has no seed template. Name at least one.");
  double sum = 0;
  for (const auto& kind : parameters.kinds) {
    if (!(kind.share >= 0)) throw InputError(name + ": a share of a template is below 0.");
    sum += kind.share;
    largest_radius = std::max(largest_radius, kind.radius);
  }
  double groups = 0;
  for (const double share : parameters.group_shares) groups += share;
  if (!(sum > 0) || !(groups > 0)) throw InputError(name + ": all shares are 0. Give at least one above 0.");
  if (auto* list = std::get_if<ListedPlaces>(&parameters.places)) {
    if (list->place.empty()) throw InputError(name + ": the list of places is empty.");
    for (const auto& place : list->place)
      if (place.kind < 0 || place.kind >= static_cast<int>(parameters.kinds.size()))
        throw InputError(name + ": the list names template number " + std::to_string(place.kind) +
                         ", but there are only " + std::to_string(parameters.kinds.size()) + " (from 0).");
    if (parameters.mass == 0 && parameters.number == 0)
      parameters.number = static_cast<int>(list->place.size());
  }
  if ((parameters.number > 0) == (parameters.mass > 0))
    throw InputError(name + ": give either a number of seeds or a mass above 0 (number " +
                     std::to_string(parameters.number) + ", mass " + std::to_string(parameters.mass) +
                     " kg).");
  const auto check_box = [&](const Vec3& low, const Vec3& high) {
    for (int d = 0; d < 3; ++d)
      if (!(high[d] > low[d]))
        throw InputError(name + ": its box has no extent along " + std::string(1, "xyz"[d]) + ".");
  };
  if (const auto* random = std::get_if<RandomPlaces>(&parameters.places))
    check_box(random->low, random->high);
  if (const auto* lattice = std::get_if<LatticePlaces>(&parameters.places)) {
    check_box(lattice->low, lattice->high);
    if (!(lattice->jitter >= 0 && lattice->jitter <= 1))
      throw InputError(name + ": the jitter is " + std::to_string(lattice->jitter) + ", allowed is 0 to 1.");
  }
}

Feeder::Candidate Feeder::candidate(int number) const {
  if (const auto* list = std::get_if<ListedPlaces>(&parameters.places)) {
    const auto& place = list->place[static_cast<std::size_t>(number) % list->place.size()];
    return {place.kind, place.group, place.orientation};
  }
  PortableRandom random(parameters.random_number, number);
  Candidate c{0, 0, {}};
  c.kind = choose(
      static_cast<int>(parameters.kinds.size()), [&](int i) { return parameters.kinds[i].share; },
      random.uniform());
  c.group = parameters.first_group + choose(
                                         static_cast<int>(parameters.group_shares.size()),
                                         [&](int i) { return parameters.group_shares[i]; }, random.uniform());
  if (parameters.random_orientation) c.orientation = random_orientation(random);
  return c;
}

bool Feeder::is_due(const Dem& dem, double mass) const {
  if (parameters.number > 0 && fed >= parameters.number) return false;
  // The seed that would overshoot the mass by more than it is missing stays out.
  if (parameters.mass > 0 && fed_mass + 0.5 * mass > parameters.mass) return false;
  return parameters.rate == 0 || fed_mass + mass <= parameters.rate * (dem.time() - parameters.start);
}

void Feeder::full(const Dem& dem, const std::string& reason) const {
  std::ostringstream text;
  text << "Feeder '" << parameters.name << "' is full after " << fed << " seeds (" << fed_mass << " kg) of ";
  if (parameters.number > 0)
    text << parameters.number;
  else
    text << parameters.mass << " kg";
  text << ": " << reason << " Enlarge its box, feed less, or let it feed as room permits.";
  if (dem.time() > 0) throw RunError("At " + std::to_string(dem.time()) + " s: " + text.str());
  throw InputError(text.str());
}

bool Feeder::place(Dem& dem, Room& room, const Candidate& seed) {
  const auto& kind = parameters.kinds[seed.kind];
  const double radius = kind.radius;
  Vec3 velocity = parameters.velocity;
  const auto put = [&](const Vec3& x) {
    const int index = dem.add_seed(kind.seed_template, x, seed.orientation, velocity);
    dem.set_group(index, seed.group);
    room.add(x, radius);
    ++fed;
    fed_mass += kind.mass;
    last_success = dem.time();
    return true;
  };

  if (const auto* list = std::get_if<ListedPlaces>(&parameters.places)) {
    if (fed >= static_cast<int>(list->place.size())) full(dem, "its list has no more places.");
    const auto& given = list->place[fed];
    const std::string obstacle = room.obstacle(given.centre, radius);
    if (!obstacle.empty()) {
      if (parameters.as_room_permits || parameters.rate > 0) return false;
      full(dem, "place " + std::to_string(fed) + " of its list at " + place_text(given.centre) +
                    " is not free: there is " + obstacle + ".");
    }
    velocity = given.velocity;
    return put(given.centre);
  }

  if (const auto* lattice = std::get_if<LatticePlaces>(&parameters.places)) {
    const double closest = 2 * largest_radius * (1 + 1e-9);
    const double spacing = lattice->spacing > 0 ? lattice->spacing : closest;
    if (spacing < closest)
      throw InputError("Feeder '" + parameters.name + "': the spacing of its lattice is " +
                       std::to_string(spacing) + " m, less than the largest seed's bounding diameter of " +
                       std::to_string(2 * largest_radius) + " m.");
    int n[3];
    for (int d = 0; d < 3; ++d)
      n[d] = static_cast<int>((lattice->high[d] - lattice->low[d]) / spacing * (1 + 1e-12));
    const long sites = static_cast<long>(n[0]) * n[1] * n[2];
    for (; next_site < sites; ++next_site) {
      PortableRandom random(parameters.random_number, place_streams + next_site);
      const int site[3] = {next_site % n[0], next_site / n[0] % n[1], next_site / n[0] / n[1]};
      Vec3 x;
      for (int d = 0; d < 3; ++d)
        x[d] = lattice->low[d] + (site[d] + 0.5) * spacing +
               lattice->jitter * (0.5 * spacing - largest_radius) * (2 * random.uniform() - 1);
      if (room.obstacle(x, radius).empty()) return ++next_site, put(x);
    }
    if (parameters.as_room_permits || parameters.rate > 0) return next_site = 0, false;
    full(dem, "its lattice has " + std::to_string(sites) + " places, and none of them is free.");
  }

  const auto& box = std::get<RandomPlaces>(parameters.places);
  const Vec3 margin{radius, radius, radius};
  for (int d = 0; d < 3; ++d)
    if (box.high[d] - box.low[d] < 2 * radius)
      throw InputError("Feeder '" + parameters.name + "': its box is smaller than a seed along " +
                       std::string(1, "xyz"[d]) + ".");
  PortableRandom random(parameters.random_number, place_streams * (1 + calls) + fed);
  for (int attempt = 0; attempt < box.tries; ++attempt) {
    const Vec3 x = random.in_box(box.low + margin, box.high - margin);
    if (room.obstacle(x, radius).empty()) return put(x);
  }
  if (parameters.as_room_permits || parameters.rate > 0) return false;
  full(dem, "no free place was found for the next one in " + std::to_string(box.tries) + " tries.");
}

int Feeder::feed(Dem& dem) {
  if (done || dem.time() < parameters.start) return 0;
  if (!begun) begun = true, last_success = dem.time();
  const auto mass_of = [&](const Candidate& c) { return parameters.kinds[c.kind].mass; };
  const int before = fed;
  Candidate next = candidate(fed);
  if (is_due(dem, mass_of(next))) {
    Room room(dem, largest_radius);
    ++calls;
    while (is_due(dem, mass_of(next)) && place(dem, room, next)) next = candidate(fed);
    if (is_due(dem, mass_of(next)) && dem.time() - last_success > parameters.patience)
      full(dem, "it has found no room for " + std::to_string(parameters.patience) + " s.");
  } else {
    last_success = dem.time();
  }
  done = parameters.number > 0 ? fed >= parameters.number : fed_mass + 0.5 * mass_of(next) > parameters.mass;
  return fed - before;
}

void Feeder::save(std::ostream& out) const {
  write_binary(out, fed), write_binary(out, calls), write_binary(out, fed_mass);
  write_binary(out, last_success), write_binary(out, next_site), write_binary(out, begun);
  write_binary(out, done);
}

void Feeder::load(std::istream& in) {
  read_binary(in, fed), read_binary(in, calls), read_binary(in, fed_mass);
  read_binary(in, last_success), read_binary(in, next_site), read_binary(in, begun);
  read_binary(in, done);
}

}  // namespace seedflow
