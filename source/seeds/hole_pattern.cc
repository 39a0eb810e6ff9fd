#include "seedflow/seeds/hole_pattern.h"

#include <algorithm>
#include <cmath>

namespace seedflow {
namespace {

double square(double a) {
  return a * a;
}
double distance_square(const PlatePoint& a, const PlatePoint& b) {
  return square(a[0] - b[0]) + square(a[1] - b[1]);
}

double row_shift(const HoleLattice& l, int row) {
  return l.staggered ? (row % 2 ? 0.25 : -0.25) * l.pitch_along : 0;
}

PlatePoint centre_of(const HoleLattice& l, int hole) {
  const int i = hole % l.n_along, j = hole / l.n_along;
  return {l.centre[0] + (i - 0.5 * (l.n_along - 1)) * l.pitch_along + row_shift(l, j),
          l.centre[1] + (j - 0.5 * (l.n_across - 1)) * l.pitch_across};
}

// The rows above and below are enough: holes that do not overlap are smaller than the pitch of the rows.
int nearest(const HoleLattice& l, const PlatePoint& x) {
  const double row = (x[1] - l.centre[1]) / l.pitch_across + 0.5 * (l.n_across - 1);
  int best = -1;
  double least = 1e300;
  for (const double candidate : {std::floor(row), std::floor(row) + 1}) {
    const int j = static_cast<int>(std::clamp(candidate, 0.0, l.n_across - 1.0));
    const double column = (x[0] - l.centre[0] - row_shift(l, j)) / l.pitch_along + 0.5 * (l.n_along - 1);
    const int i = static_cast<int>(std::clamp(std::floor(column + 0.5), 0.0, l.n_along - 1.0));
    const int hole = i + l.n_along * j;
    const double d = distance_square(x, centre_of(l, hole));
    if (d < least) least = d, best = hole;
  }
  return best;
}

PlatePoint centre_of(const HoleRing& r, int hole) {
  const double angle = r.first_angle + 2 * M_PI * hole / r.n;
  return {r.pitch_radius * std::cos(angle), r.pitch_radius * std::sin(angle)};
}

int nearest(const HoleRing& r, const PlatePoint& x) {
  const double turn = (std::atan2(x[1], x[0]) - r.first_angle) / (2 * M_PI) * r.n;
  const int hole = static_cast<int>(std::floor(turn + 0.5)) % r.n;
  return hole < 0 ? hole + r.n : hole;
}

struct Count {
  int operator()(std::monostate) const { return 0; }
  int operator()(const HoleLattice& l) const { return l.n_along * l.n_across; }
  int operator()(const HoleRing& r) const { return r.n; }
  int operator()(const HoleList& l) const { return static_cast<int>(l.centre.size()); }
};

struct Centre {
  int hole;
  PlatePoint operator()(std::monostate) const { return {0, 0}; }
  PlatePoint operator()(const HoleList& l) const { return l.centre[hole]; }
  template <class Pattern>
  PlatePoint operator()(const Pattern& p) const {
    return centre_of(p, hole);
  }
};

struct Nearest {
  const PlatePoint& x;
  int operator()(std::monostate) const { return -1; }
  int operator()(const HoleList& l) const { return l.nearest(x); }
  template <class Pattern>
  int operator()(const Pattern& p) const {
    return nearest(p, x);
  }
};

struct LeastDistance {
  double operator()(std::monostate) const { return 1e300; }
  double operator()(const HoleLattice& l) const {
    double least = 1e300;
    if (l.n_along > 1) least = l.pitch_along;
    if (l.n_across > 1)
      least = std::min(least, l.staggered ? std::hypot(0.5 * l.pitch_along, l.pitch_across) : l.pitch_across);
    if (l.staggered && l.n_across > 2) least = std::min(least, 2 * l.pitch_across);
    return least;
  }
  double operator()(const HoleRing& r) const {
    return r.n > 1 ? 2 * r.pitch_radius * std::sin(M_PI / r.n) : 1e300;
  }
  double operator()(const HoleList& l) const {
    // Sorted by the first coordinate: only neighbours within the best distance so far are compared.
    std::vector<PlatePoint> p = l.centre;
    std::sort(p.begin(), p.end());
    double least = 1e300;
    for (std::size_t i = 0; i < p.size(); ++i)
      for (std::size_t j = i + 1; j < p.size() && p[j][0] - p[i][0] < least; ++j)
        least = std::min(least, std::sqrt(distance_square(p[i], p[j])));
    return least;
  }
};

}  // namespace

void HoleList::make_grid(double reach) {
  if (centre.empty()) return;
  PlatePoint high = low = centre[0];
  for (const PlatePoint& x : centre)
    for (int d : {0, 1}) low[d] = std::min(low[d], x[d]), high[d] = std::max(high[d], x[d]);
  for (int d : {0, 1}) low[d] -= reach, high[d] += reach;
  const double area = (high[0] - low[0]) * (high[1] - low[1]);
  cell = std::max(2 * reach, std::sqrt(area / static_cast<double>(centre.size())));
  for (int d : {0, 1}) n[d] = static_cast<int>((high[d] - low[d]) / cell) + 1;
  std::vector<std::vector<int>> members(static_cast<std::size_t>(n[0]) * n[1]);
  for (int hole = 0; hole < static_cast<int>(centre.size()); ++hole) {
    // In every cell from which the hole can be reached.
    std::array<int, 2> from, to;
    for (int d : {0, 1}) {
      from[d] = std::max(0, static_cast<int>((centre[hole][d] - reach - low[d]) / cell));
      to[d] = std::min(n[d] - 1, static_cast<int>((centre[hole][d] + reach - low[d]) / cell));
    }
    for (int j = from[1]; j <= to[1]; ++j)
      for (int i = from[0]; i <= to[0]; ++i) members[i + n[0] * j].push_back(hole);
  }
  first.assign(1, 0), member.clear();
  for (const auto& m : members) {
    member.insert(member.end(), m.begin(), m.end());
    first.push_back(static_cast<int>(member.size()));
  }
}

int HoleList::nearest(const PlatePoint& x) const {
  std::array<int, 2> place;
  for (int d : {0, 1}) {
    const double a = std::floor((x[d] - low[d]) / cell);
    if (!(a >= 0 && a < n[d])) return -1;
    place[d] = static_cast<int>(a);
  }
  int best = -1;
  double least = 1e300;
  const int c = place[0] + n[0] * place[1];
  for (int k = first[c]; k < first[c + 1]; ++k) {
    const double d = distance_square(x, centre[member[k]]);
    if (d < least) least = d, best = member[k];
  }
  return best;
}

int n_holes(const HolePattern& pattern) {
  return std::visit(Count{}, pattern);
}
PlatePoint hole_centre(const HolePattern& pattern, int hole) {
  return std::visit(Centre{hole}, pattern);
}
int nearest_hole(const HolePattern& pattern, const PlatePoint& x) {
  return std::visit(Nearest{x}, pattern);
}
double least_hole_distance(const HolePattern& pattern) {
  return std::visit(LeastDistance{}, pattern);
}

}  // namespace seedflow
