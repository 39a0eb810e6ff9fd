#include "seedflow/mesh/hole_plane.h"

#include <algorithm>
#include <cmath>

namespace seedflow {

using dealii::Point;
using dealii::Tensor;

std::vector<double> graded_layers(double length, double first, double growth, double largest) {
  std::vector<double> ends{0};
  for (double width = std::min(first, length); ends.back() < length;
       width = std::min(growth * width, largest))
    ends.push_back(ends.back() + width);
  // The last layer reaches beyond: either stretch without it or shrink with it, whichever changes less.
  if (ends.size() > 2 && length / ends[ends.size() - 2] < ends.back() / length) ends.pop_back();
  const double scale = length / ends.back();
  for (double& end : ends) end *= scale;
  ends.back() = length;
  ends.erase(ends.begin());
  return ends;
}

unsigned int HolePlane::add_node(const Point<2>& position) {
  nodes.push_back({position, {}});
  return nodes.size() - 1;
}

std::vector<double> HolePlane::side_positions(int m) {
  std::vector<double> t;
  for (int i = 0; i <= m; ++i) t.push_back(std::tan(M_PI / 4 * (2.0 * i / m - 1)));
  return t;
}

void HolePlane::add_hole(const Point<2>& centre, const Tensor<1, 2>& along, int core_rings,
                         const std::vector<double>& outside, const std::vector<unsigned int>& loop) {
  const int around = static_cast<int>(loop.size()), m = around / 4;
  const Tensor<1, 2> across({-along[1], along[0]});
  const double equal_area = std::sqrt(2 * M_PI / (around * std::sin(2 * M_PI / around)));
  const auto local = [&](double x, double y) { return x * along + y * across; };
  const auto add = [&](const Point<2>& fixed, const Tensor<1, 2>& by_radius) {
    nodes.push_back({fixed, by_radius});
    return static_cast<unsigned int>(nodes.size() - 1);
  };

  // The core: a square with rounded sides, within 0.69 of the radius.
  const double half = 0.55, round = 0.4;
  const std::vector<double> t = side_positions(m);
  std::vector<unsigned int> core;
  for (int j = 0; j <= m; ++j)
    for (int i = 0; i <= m; ++i) {
      const double x = t[i] * (1 - round + round * std::sqrt(1 - 0.5 * t[j] * t[j])),
                   y = t[j] * (1 - round + round * std::sqrt(1 - 0.5 * t[i] * t[i]));
      core.push_back(add(centre, half * local(x, y)));
    }
  const auto at = [&](int i, int j) { return core[j * (m + 1) + i]; };
  for (int j = 0; j < m; ++j)
    for (int i = 0; i < m; ++i) add_quad(at(i, j), at(i + 1, j), at(i, j + 1), at(i + 1, j + 1), true);

  std::vector<unsigned int> inner;
  for (int i = 0; i < around; ++i) {
    const int side = i / m, k = i % m;
    inner.push_back(side == 0 ? at(k, 0) : side == 1 ? at(m, k) : side == 2 ? at(m - k, m) : at(0, m - k));
  }
  const std::vector<unsigned int> edge = inner;
  const auto ring = [&](const std::vector<unsigned int>& outer, bool in_hole) {
    for (int i = 0; i < around; ++i) {
      const int next = (i + 1) % around;
      add_quad(outer[i], outer[next], inner[i], inner[next], in_hole);
    }
    inner = outer;
  };
  const auto circle = [&](int i) {
    const double angle = -0.75 * M_PI + 2 * M_PI * i / around;
    return equal_area * local(std::cos(angle), std::sin(angle));
  };
  for (int r = 1; r <= core_rings; ++r) {
    const double s = double(r) / core_rings;
    std::vector<unsigned int> outer;
    for (int i = 0; i < around; ++i)
      outer.push_back(add(centre, (1 - s) * nodes[edge[i]].by_radius + s * circle(i)));
    ring(outer, true);
  }
  for (const double s : outside) {
    std::vector<unsigned int> outer;
    for (int i = 0; i < around; ++i) {
      const Tensor<1, 2> offset = nodes[loop[i]].fixed - centre;
      outer.push_back(add(centre + s * offset, (1 - s) * circle(i)));
    }
    ring(outer, false);
  }
  ring(loop, false);
}

}  // namespace seedflow
