#include "seedflow/seeds/region.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "seedflow/base/binary.h"
#include "seedflow/base/error.h"
#include "seedflow/seeds/dem.h"

namespace seedflow {

bool BoxRegion::has(const Vec3& x) const {
  for (int d = 0; d < 3; ++d)
    if (!(x[d] >= low[d] && x[d] <= high[d])) return false;
  return true;
}

bool CylinderRegion::has(const Vec3& x) const {
  const Vec3 d = x - base;
  const double z = dot(d, axis);
  return z >= 0 && z <= length && norm_square(d - z * axis) <= radius * radius;
}

bool Region::has(const Vec3& x) const {
  return std::visit([&](const auto& s) { return s.has(x); }, shape);
}

namespace {

struct CheckShape {
  const std::string& where;
  void operator()(BoxRegion& s) const {
    for (int d = 0; d < 3; ++d)
      if (!(s.high[d] > s.low[d]))
        throw InputError(where + ": the box has no extent along " + std::string(1, "xyz"[d]) +
                         ". Its high corner must lie above its low corner in x, y and z.");
  }
  void operator()(HalfSpaceRegion& s) const {
    if (!(norm(s.normal) > 0))
      throw InputError(where + ": the normal is zero. Give the direction into the region.");
  }
  void operator()(CylinderRegion& s) const {
    if (!(norm(s.axis) > 0)) throw InputError(where + ": the axis is zero. Give its direction.");
    if (!(s.radius > 0 && s.length > 0))
      throw InputError(where + ": a cylinder needs a radius and a length above 0 m.");
    s.axis /= norm(s.axis);
  }
};

bool contains(const std::vector<long>& sorted, long label) {
  return std::binary_search(sorted.begin(), sorted.end(), label);
}
void insert(std::vector<long>& sorted, long label) {
  sorted.insert(std::lower_bound(sorted.begin(), sorted.end(), label), label);
}

}  // namespace

void Region::check() {
  const std::string where = "Region '" + name + "'";
  std::visit(CheckShape{where}, shape);
}

RegionCensus::RegionCensus(std::vector<Region> regions) : region(std::move(regions)) {
  for (std::size_t r = 0; r < region.size(); ++r) {
    region[r].check();
    for (std::size_t other = 0; other < r; ++other)
      if (region[other].name == region[r].name)
        throw InputError("There are two regions '" + region[r].name +
                         "'. Give every region a name of its own.");
  }
  seen.resize(region.size());
  known.resize(region.size());
  inside.assign(region.size(), 0);
}

double RegionCensus::mass_counted(int which) const {
  double sum = 0;
  for (const RegionEntry& e : seen[which]) sum += e.mass;
  return sum;
}

void RegionCensus::update(Dem& dem) {
  // New seeds have labels above all that were there; what was there must still be there.
  std::vector<long> now;
  for (int s = 0; s < dem.n_seeds(); ++s) now.push_back(dem.seed_label(s));
  std::vector<long> lost;
  std::set_difference(present.begin(), present.end(), now.begin(), now.end(), std::back_inserter(lost));
  double mass_present = 0;
  for (int s = 0; s < dem.n_seeds(); ++s) {
    const double mass = dem.seed_template(s).mass;
    mass_present += mass;
    if (contains(present, now[s])) continue;
    ++n_appeared;
    mass_appeared += mass;
  }
  if (!lost.empty() || n_appeared != dem.n_seeds() + n_gone ||
      std::abs(mass_appeared - mass_present - mass_gone) > 1e-9 * mass_appeared) {
    std::ostringstream text;
    text << "At " << dem.time() << " s seeds are missing that no region has taken out: " << n_appeared
         << " came in, " << dem.n_seeds() << " are present, " << n_gone << " were taken out (masses "
         << mass_appeared << ", " << mass_present << ", " << mass_gone << " kg).";
    if (!lost.empty()) text << " The first has the label " << lost.front() << ".";
    throw RunError(text.str());
  }

  std::fill(inside.begin(), inside.end(), 0);
  std::vector<int> leaving;
  for (int s = 0; s < dem.n_seeds(); ++s) {
    const Vec3 centre = dem.seed_state(s).centre;
    const double mass = dem.seed_template(s).mass;
    bool leaves = false;
    for (std::size_t r = 0; r < region.size() && !leaves; ++r) {
      if (!region[r].has(centre)) continue;
      ++inside[r];
      if (contains(known[r], now[s])) continue;
      if (region[r].action == Region::Action::keep) {
        if (contains(kept, now[s])) continue;
        insert(kept, now[s]);
      }
      insert(known[r], now[s]);
      seen[r].push_back({now[s], dem.seed_group(s), mass, dem.time()});
      if (region[r].action != Region::Action::remove) continue;
      leaves = true;
      --inside[r];
      ++n_gone;
      mass_gone += mass;
      leaving.push_back(s);
    }
  }
  for (const int s : leaving) now[s] = -1;
  now.erase(std::remove(now.begin(), now.end(), -1), now.end());
  present = std::move(now);
  dem.remove_seeds(leaving);
}

void RegionCensus::save(std::ostream& out) const {
  for (std::size_t r = 0; r < region.size(); ++r) write_binary(out, seen[r]), write_binary(out, known[r]);
  write_binary(out, kept);
  write_binary(out, inside);
  write_binary(out, present);
  write_binary(out, n_appeared);
  write_binary(out, n_gone);
  write_binary(out, mass_appeared);
  write_binary(out, mass_gone);
}

void RegionCensus::load(std::istream& in) {
  for (std::size_t r = 0; r < region.size(); ++r) read_binary(in, seen[r]), read_binary(in, known[r]);
  read_binary(in, kept);
  read_binary(in, inside);
  if (inside.size() != region.size())
    throw RunError("The saved state has " + std::to_string(inside.size()) + " regions, this set-up has " +
                   std::to_string(region.size()) + ". Resume with the input the state was made with.");
  read_binary(in, present);
  read_binary(in, n_appeared);
  read_binary(in, n_gone);
  read_binary(in, mass_appeared);
  read_binary(in, mass_gone);
}

}  // namespace seedflow
