#include "seedflow/seeds/neighbour_skin.h"

#include <algorithm>
#include <cmath>

#include "seedflow/base/binary.h"

namespace seedflow {
namespace {

// Nanoseconds on one core of 2021, by profile; only their ratios matter.
constexpr double search_seed = 400, search_sphere = 25, search_pair = 60, search_at_wall = 100;
constexpr double look_at_pair = 2, bring_sphere = 8, look_at_wall = 25;

// A quiet heap moves by nothing: from here on longer lists save nothing.
constexpr double longest_interval = 2000;

double cost_of_substep(const ListSizes::Within& w) {
  return look_at_pair * w.pairs + bring_sphere * w.spheres + look_at_wall * w.at_walls;
}

}  // namespace

double NeighbourSkin::cost_of_search(const ListSizes::Within& w) const {
  return search_seed * n_seeds + search_sphere * n_spheres + search_pair * w.pairs +
         search_at_wall * w.at_walls;
}

double NeighbourSkin::begin(double smallest_sphere, double smallest_seed) {
  if (fixed > 0) return fixed;
  smallest = 0.02 * smallest_sphere;
  largest = std::max(0.25 * smallest_sphere, 0.5 * smallest_seed);
  if (skin == 0) skin = 0.25 * smallest_sphere;
  skin = std::min(std::max(skin, smallest), largest);
  return skin;
}

void NeighbourSkin::moved(double way, double substeps) {
  if (fixed > 0 || skin == 0) return;
  const double per_substep = std::max(way / substeps, smallest / longest_interval);
  const double with_skin = cost_of_search(listed.whole), with_half = cost_of_search(listed.half);
  // Without a skin, by extrapolation.
  const double search = std::max(2 * with_half - with_skin, 0.1 * with_skin);
  const double growth =
      2 * (cost_of_substep(listed.whole) - cost_of_substep(listed.half)) / skin;  // per metre of skin
  const double best = growth > 0 ? std::sqrt(search * per_substep / growth) : largest;
  const auto bounded = [&](double s) { return std::min(std::max(s, smallest), largest); };
  skin = bounded(std::min(std::max(best, 0.5 * skin), 2 * skin));
  patience = skin > smallest ? 4 * bounded(best) / per_substep : 1e300;
}

void NeighbourSkin::save(std::ostream& out) const {
  write_binary(out, skin);
  write_binary(out, patience);
}

void NeighbourSkin::load(std::istream& in) {
  read_binary(in, skin);
  read_binary(in, patience);
}

}  // namespace seedflow
