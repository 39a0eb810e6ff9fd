// A plate with holes cut into trapezoids by the lines through all corners.

#include <algorithm>
#include <array>
#include <cmath>

#include "seedflow/seeds/wall_polygons.h"

namespace seedflow {
namespace {

using Point = std::array<double, 2>;
using Ring = std::vector<Point>;

// Where the line at this height enters and leaves a convex ring.
std::pair<double, double> chord(const Ring& ring, double height) {
  double low = 1e300, high = -1e300;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point &a = ring[i], &b = ring[(i + 1) % ring.size()];
    if (std::min(a[1], b[1]) > height || std::max(a[1], b[1]) < height) continue;
    const double part = a[1] == b[1] ? 0 : (height - a[1]) / (b[1] - a[1]);
    for (const double x : {a[0] + part * (b[0] - a[0]), a[1] == b[1] ? b[0] : a[0] + part * (b[0] - a[0])})
      low = std::min(low, x), high = std::max(high, x);
  }
  return {low, high};
}

std::pair<double, double> extent(const Ring& ring) {
  std::pair<double, double> e{1e300, -1e300};
  for (const Point& x : ring) e.first = std::min(e.first, x[1]), e.second = std::max(e.second, x[1]);
  return e;
}

}  // namespace

std::vector<Ring> trapezoids(const Ring& outer, const std::vector<Ring>& inner) {
  const auto [bottom, top] = extent(outer);
  const double same = 1e-9 * (top - bottom);
  std::vector<double> heights;
  for (const Point& x : outer) heights.push_back(x[1]);
  std::vector<std::pair<std::pair<double, double>, int>> holes;  // extent, number
  for (std::size_t h = 0; h < inner.size(); ++h) {
    for (const Point& x : inner[h]) heights.push_back(x[1]);
    holes.push_back({extent(inner[h]), static_cast<int>(h)});
  }
  std::sort(heights.begin(), heights.end());
  std::sort(holes.begin(), holes.end());
  std::vector<double> line;
  for (const double h : heights)
    if (line.empty() || h > line.back() + same) line.push_back(h);

  std::vector<Ring> out;
  std::vector<int> active;
  std::size_t next = 0;
  for (std::size_t k = 0; k + 1 < line.size(); ++k) {
    const double middle = 0.5 * (line[k] + line[k + 1]), step = 1e-6 * (line[k + 1] - line[k]);
    while (next < holes.size() && holes[next].first.first < middle) active.push_back(holes[next++].second);
    active.erase(
        std::remove_if(active.begin(), active.end(), [&](int h) { return extent(inner[h]).second < middle; }),
        active.end());
    // Lines that stand for several nearly equal heights may just miss a ring: look a little inside the strip.
    const double low = line[k] + step, high = line[k + 1] - step;
    std::vector<std::array<double, 4>> solid;  // left and right of the holes, below and above
    for (const int h : active) {
      const auto a = chord(inner[h], low), b = chord(inner[h], high);
      if (a.first <= a.second && b.first <= b.second) solid.push_back({a.first, a.second, b.first, b.second});
    }
    std::sort(solid.begin(), solid.end());
    const auto a = chord(outer, low), b = chord(outer, high);
    double left_low = a.first, left_high = b.first;
    const auto emit = [&](double right_low, double right_high) {
      out.push_back(
          {{left_low, line[k]}, {right_low, line[k]}, {right_high, line[k + 1]}, {left_high, line[k + 1]}});
    };
    for (const auto& hole : solid) {
      emit(hole[0], hole[2]);
      left_low = hole[1], left_high = hole[3];
    }
    emit(a.second, b.second);
  }
  return out;
}

}  // namespace seedflow
