#include "seedflow/seeds/packing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <utility>

#include "seedflow/base/error.h"
#include "seedflow/seeds/packing_random.h"

namespace seedflow {
namespace {

/// Soft spheres of radius rho whose centres are confined to the shape moved inwards by r.
class Relaxation {
 public:
  Relaxation(const Shape& shape, int n, double r, PortableRandom random)
      : shape(shape), inset(r), x(n), v(n), force(n), wall(n), depth(n, 0.0), depth_at(n), allowed_at(n) {
    for (int i = 0; i < n; ++i) {
      // Uniform where a sphere fits; if that is too rare to be hit by chance, next to the deepest point.
      Vec3 outward;
      int tries = 0;
      do x[i] = random.in_box(shape.low, shape.high);
      while (++tries < 2000 && shape.signed_distance(x[i], outward) + r > 0);
      if (tries == 2000) x[i] = shape.deepest + (1e-3 / tries) * x[i];
      allowed_at[i] = shape.deepest;
      confine(i);
    }
  }

  Packing jam() {
    double rho = dense_radius();
    for (int step = 0; step < 60; ++step) {
      relax(rho);
      const auto [largest, mean] = overlaps(rho);
      if (largest < 1e-4) break;
      rho *= 1 - std::max(1.2 * mean, 2e-5);
    }
    return {x, smallest_distance()};
  }

 private:
  /// A radius at which the spheres are denser than they can be: fill 0.68 of the ball of equal volume in
  /// which their surfaces could lie if the centres stay inside the inset shape.
  double dense_radius() const {
    const double ball = std::cbrt(3 * shape.volume / (4 * M_PI));
    const double fill = std::cbrt(0.68 / static_cast<double>(x.size()));
    return std::max((ball - inset) * fill / (1 - std::min(fill, 0.9)), 1e-3 * ball);
  }

  /// Moves centre i to the nearest allowed point, by repeated steps along the normal where the shape is not
  /// convex; if those lead nowhere (a place too narrow for the sphere), back to where it last was allowed.
  /// The distance changes by no more than the way moved, so a centre known to be deep inside is not asked
  /// again until it may have left.
  void confine(int i) {
    if (depth[i] > 0 && norm_square(x[i] - depth_at[i]) < depth[i] * depth[i]) return;
    for (int repeat = 0; repeat < 20; ++repeat) {
      Vec3 outward;
      const double excess = shape.signed_distance(x[i], outward) + inset;
      depth[i] = -excess;
      depth_at[i] = x[i];
      if (excess <= 0) {
        allowed_at[i] = x[i];
        if (repeat == 0) wall[i] = {};
        return;
      }
      wall[i] = outward;
      x[i] -= (excess + 1e-12 * inset) * outward;
      const double leaving = dot(v[i], outward);
      if (leaving > 0) v[i] -= leaving * outward;
    }
    x[i] = allowed_at[i];
    v[i] = {};
    depth[i] = 0;
  }

  void find_pairs(double cutoff) {
    pairs.clear();
    const int n = static_cast<int>(x.size());
    for (int i = 0; i < n; ++i)
      for (int j = i + 1; j < n; ++j)
        if (norm_square(x[i] - x[j]) < cutoff * cutoff) pairs.emplace_back(i, j);
    listed_at = x;
  }

  bool list_outdated(double slack) const {
    for (std::size_t i = 0; i < x.size(); ++i)
      if (norm_square(x[i] - listed_at[i]) > 0.25 * slack * slack) return true;
    return false;
  }

  /// Unit masses, unit stiffness, linear repulsion; what presses a sphere against the hull is borne by the
  /// hull.
  void compute_forces(double diameter) {
    std::fill(force.begin(), force.end(), Vec3{});
    for (const auto& [i, j] : pairs) {
      const Vec3 d = x[i] - x[j];
      const double square = norm_square(d);
      if (square >= diameter * diameter || square == 0) continue;
      const double distance = std::sqrt(square);
      const Vec3 f = ((diameter - distance) / distance) * d;
      force[i] += f;
      force[j] -= f;
    }
    for (std::size_t i = 0; i < x.size(); ++i) {
      const double pressing = dot(force[i], wall[i]);
      if (pressing > 0) force[i] -= pressing * wall[i];
    }
  }

  void relax(double rho) {
    const double diameter = 2 * rho, slack = 0.3 * diameter, still = 1e-7 * diameter;
    double dt = 0.1, mixing = 0.1;
    int downhill = 0;
    std::fill(v.begin(), v.end(), Vec3{});
    find_pairs(diameter + slack);
    for (int step = 0; step < 300; ++step) {
      if (list_outdated(slack)) find_pairs(diameter + slack);
      compute_forces(diameter);
      double power = 0, vv = 0, ff = 0;
      for (std::size_t i = 0; i < x.size(); ++i)
        power += dot(force[i], v[i]), vv += norm_square(v[i]), ff += norm_square(force[i]);
      if (ff == 0) return;
      if (power < 0) {
        std::fill(v.begin(), v.end(), Vec3{});
        dt *= 0.5, mixing = 0.1, downhill = 0;
      } else {
        const double turn = mixing * std::sqrt(vv / ff);
        for (std::size_t i = 0; i < x.size(); ++i) v[i] = (1 - mixing) * v[i] + turn * force[i];
        if (++downhill > 5) dt = std::min(1.1 * dt, 0.6), mixing *= 0.99;
      }
      double moved = 0;
      for (std::size_t i = 0; i < x.size(); ++i) {
        const Vec3 before = x[i];
        v[i] += dt * force[i];
        x[i] += dt * v[i];
        confine(static_cast<int>(i));
        moved = std::max(moved, norm_square(x[i] - before));
      }
      if (step > 20 && moved < still * still && power >= 0) return;
    }
  }

  /// Largest and mean relative overlap of the pairs that overlap at this packing radius.
  std::pair<double, double> overlaps(double rho) const {
    double largest = 0, sum = 0;
    int count = 0;
    for (const auto& [i, j] : pairs) {
      const double overlap = 1 - norm(x[i] - x[j]) / (2 * rho);
      if (overlap <= 0) continue;
      largest = std::max(largest, overlap), sum += overlap, ++count;
    }
    return {largest, count ? sum / count : 0.0};
  }

  double smallest_distance() const {
    double smallest = std::numeric_limits<double>::max();
    for (std::size_t i = 0; i < x.size(); ++i)
      for (std::size_t j = i + 1; j < x.size(); ++j) smallest = std::min(smallest, norm_square(x[i] - x[j]));
    return std::sqrt(smallest);
  }

  const Shape& shape;
  const double inset;
  std::vector<Vec3> x, v, force, listed_at;
  std::vector<Vec3> wall;     ///< outward normal of the hull where a sphere was last held by it, else zero
  std::vector<double> depth;  ///< last known distance to the boundary of the allowed region
  std::vector<Vec3> depth_at, allowed_at;
  std::vector<std::pair<int, int>> pairs;
};

}  // namespace

Packing pack_spheres(const Shape& shape, int n, double r, std::uint64_t random_number, int attempts) {
  std::ostringstream reason;
  if (n < 1) reason << "the number of sub-spheres is " << n << "; at least 1 is needed.";
  if (!(r > 0) || r > shape.inscribed_radius * (1 + 1e-9))
    reason << "a sub-sphere of radius " << r << " m does not fit into the seed; allowed: above 0, at most "
           << shape.inscribed_radius << " m.";
  if (!reason.str().empty()) throw InputError("Packing of sub-spheres: " + reason.str());

  if (n == 1) return {{shape.deepest}, 0.0};
  Packing best;
  for (int attempt = 0; attempt < std::max(attempts, 1); ++attempt) {
    Packing found = Relaxation(shape, n, r, PortableRandom(random_number, attempt)).jam();
    if (attempt == 0 || found.smallest_distance > best.smallest_distance) best = std::move(found);
  }
  return best;
}

}  // namespace seedflow
