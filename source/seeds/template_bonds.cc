#include "seedflow/seeds/template_bonds.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <sstream>
#include <vector>

#include "seedflow/base/error.h"

namespace seedflow {
namespace {

int count_pieces(const SeedTemplate& seed) {
  std::vector<int> piece(seed.n_spheres());
  std::iota(piece.begin(), piece.end(), 0);
  const auto root = [&](int i) {
    while (piece[i] != i) i = piece[i] = piece[piece[i]];
    return i;
  };
  int pieces = seed.n_spheres();
  for (const Bond& b : seed.bond) {
    const int i = root(b.first), j = root(b.second);
    if (i != j) piece[j] = i, --pieces;
  }
  return pieces;
}

}  // namespace

void bond_by_contact_radius(SeedTemplate& seed, double contact_factor, double bond_factor) {
  if (!(contact_factor > 0) || !(bond_factor > 0) || !std::isfinite(bond_factor)) {
    std::ostringstream message;
    message << "Seed template '" << seed.name << "': contact radius factor " << contact_factor
            << " and bond radius factor " << bond_factor << " must be positive.";
    throw InputError(message.str());
  }
  seed.bond.clear();
  for (int i = 0; i < seed.n_spheres(); ++i)
    for (int j = i + 1; j < seed.n_spheres(); ++j)
      if (norm(seed.position[i] - seed.position[j]) < contact_factor * (seed.radius[i] + seed.radius[j]))
        seed.bond.push_back({i, j, bond_factor * std::min(seed.radius[i], seed.radius[j])});
}

double connecting_contact_factor(const SeedTemplate& seed) {
  // Prim's minimum spanning tree over distance / (r_i + r_j); its longest edge is the answer.
  const int n = seed.n_spheres();
  std::vector<double> reach(n, std::numeric_limits<double>::infinity());
  std::vector<bool> joined(n, false);
  double longest = 0;
  int last = 0;
  for (int step = 1; step < n; ++step) {
    joined[last] = true;
    int next = -1;
    for (int i = 0; i < n; ++i) {
      if (joined[i]) continue;
      reach[i] = std::min(
          reach[i], norm(seed.position[i] - seed.position[last]) / (seed.radius[i] + seed.radius[last]));
      if (next < 0 || reach[i] < reach[next]) next = i;
    }
    longest = std::max(longest, reach[next]);
    last = next;
  }
  return longest;
}

void require_one_piece(const SeedTemplate& seed) {
  const int pieces = count_pieces(seed);
  if (pieces <= 1) return;
  // Rounded up in the fourth digit, so that the printed factor is enough (pairs must be nearer, not as near).
  const double factor = std::ceil(connecting_contact_factor(seed) * 1e4 + 1e-6) * 1e-4;
  std::ostringstream message;
  message << "Seed template '" << seed.name << "': its " << seed.n_spheres() << " sub-spheres and "
          << seed.bond.size() << " bonds fall into " << pieces << " pieces; they must hold together as one. "
          << "A contact radius of " << factor * *std::max_element(seed.radius.begin(), seed.radius.end())
          << " m (contact radius factor " << factor << ") would connect it.";
  throw InputError(message.str());
}

}  // namespace seedflow
