#include "seedflow/coupling/kernels.h"

#include <cmath>

namespace seedflow {

using dealii::Point;

namespace {

void add_uniformly_in_cell(PointExchange& row, const QuadratureLayout<3>& layout, int cell, double share) {
  const std::uint32_t first = cell * layout.n_q;
  for (std::uint32_t q = first; q < first + layout.n_q; ++q)
    row.add(q, share * layout.JxW[q] / layout.cell_volume[cell]);
}

}  // namespace

void add_cell_kernel(PointExchange& row, const PointLocation<3>& location, const QuadratureLayout<3>& layout,
                     const Vec3& point) {
  const int cell = location.cell_of({point.x, point.y, point.z});
  if (cell != PointLocation<3>::not_here) add_uniformly_in_cell(row, layout, cell, 1.0);
}

void add_sampled_kernel(PointExchange& row, const PointLocation<3>& location,
                        const QuadratureLayout<3>& layout, const Vec3& centre, double radius, int samples) {
  // Neighbouring samples mostly share a cell; they are counted first and written once per cell.
  std::vector<std::pair<int, int>> count;  // cell, samples in it
  const double spacing = 2.0 * radius / samples, first = -radius + 0.5 * spacing;
  int cell = PointLocation<3>::not_here;  // of the sample before: the first guess
  for (int i = 0; i < samples; ++i)
    for (int j = 0; j < samples; ++j)
      for (int k = 0; k < samples; ++k) {
        const Vec3 offset{first + i * spacing, first + j * spacing, first + k * spacing};
        if (norm_square(offset) > radius * radius) continue;
        const Vec3 x = centre + offset;
        cell = location.cell_of({x.x, x.y, x.z}, cell);
        if (cell == PointLocation<3>::not_here) continue;
        auto found = count.begin();
        while (found != count.end() && found->first != cell) ++found;
        if (found == count.end())
          count.push_back({cell, 1});
        else
          ++found->second;
      }
  for (const auto& [cell, n] : count) add_uniformly_in_cell(row, layout, cell, n);
}

void add_gaussian_kernel(PointExchange& row, const PointLocation<3>& location,
                         const QuadratureLayout<3>& layout, const Vec3& centre, double sigma) {
  const double reach = gaussian_cut_off * sigma, factor = -0.5 / (sigma * sigma);
  const Point<3> c(centre.x, centre.y, centre.z);
  Point<3> low = c, high = c;
  for (int d = 0; d < 3; ++d) low[d] -= reach, high[d] += reach;
  location.cells_in_box(low, high, [&](int cell) {
    const std::uint32_t first = cell * layout.n_q;
    for (std::uint32_t q = first; q < first + layout.n_q; ++q) {
      const double r2 = layout.position[q].distance_square(c);
      if (r2 < reach * reach) row.add(q, std::exp(factor * r2) * layout.JxW[q]);
    }
  });
}

}  // namespace seedflow
