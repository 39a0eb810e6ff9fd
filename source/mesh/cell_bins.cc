#include "seedflow/mesh/cell_bins.h"

#include <algorithm>
#include <cmath>

namespace seedflow {

using dealii::Point;
using dealii::Tensor;

template <int dim>
MultilinearCell<dim>::MultilinearCell(const std::array<Point<dim>, 1 << dim>& vertices) {
  for (int m = 0; m < 1 << dim; ++m)
    for (int v = 0; v < 1 << dim; ++v) {
      double factor = 1;
      for (int d = 0; d < dim; ++d) factor *= m >> d & 1 ? (v >> d & 1 ? 1 : -1) : 0.5;
      coefficient[m] += factor * vertices[v];
    }
  Tensor<2, dim> jacobian;
  for (int d = 0; d < dim; ++d)
    for (int e = 0; e < dim; ++e) jacobian[d][e] = coefficient[1 << e][d];
  inverse = invert(jacobian);
  for (int m = 0; m < 1 << dim; ++m) {
    int members = 0;
    for (int d = 0; d < dim; ++d) members += m >> d & 1;
    if (members < 2) continue;
    const Tensor<1, dim> s = inverse * coefficient[m];
    double largest = 0;
    for (int d = 0; d < dim; ++d) largest = std::max(largest, std::abs(s[d]));
    bend += largest * std::pow(0.5, members);
  }
}

template <int dim>
double MultilinearCell<dim>::outside(const Point<dim>& x) const {
  constexpr double never = std::numeric_limits<double>::infinity();
  Tensor<1, dim> offset;
  for (int d = 0; d < dim; ++d) offset[d] = x[d] - coefficient[0][d];
  Tensor<1, dim> s = inverse * offset;
  const auto beyond = [&s] {
    double largest = 0;
    for (int d = 0; d < dim; ++d) largest = std::max(largest, std::abs(s[d]));
    return largest - 0.5;
  };
  // x(s) = centre + J s + N(s), |J^-1 N| <= bend in the cell: then s = J^-1 (x - centre) - J^-1 N(s) has a
  // solution in the cell, by Brouwer's fixed-point theorem.
  if (alone && beyond() + bend < -certainty) return beyond() + bend;
  // Beyond the cell's faces the bent terms grow: twice their size within it up to s = 0.7.
  if (!(beyond() < 2 * (bend + reach))) return never;
  for (int iteration = 0; iteration < 20; ++iteration) {
    double basis[1 << dim];
    basis[0] = 1;
    for (int d = 0; d < dim; ++d)
      for (int m = 0; m < 1 << d; ++m) basis[m | 1 << d] = basis[m] * s[d];
    Tensor<1, dim> left = offset;
    Tensor<2, dim> jacobian;
    for (int m = 1; m < 1 << dim; ++m)
      for (int e = 0; e < dim; ++e) {
        left[e] -= basis[m] * coefficient[m][e];
        for (int d = 0; d < dim; ++d)
          if (m >> d & 1) jacobian[e][d] += basis[m ^ 1 << d] * coefficient[m][e];
      }
    const Tensor<1, dim> step = invert(jacobian) * left;
    s += step;
    double change = 0;
    for (int d = 0; d < dim; ++d) change = std::max(change, std::abs(step[d]));
    const double result = beyond();
    // The error left is of the order change^2.
    if (change < 1e-8 || (alone && std::abs(result) > 2 * change && change < 0.2)) return result;
    if (!(result < 2)) return never;
  }
  return never;
}

template <int dim>
CellBins<dim>::CellBins(std::vector<MultilinearCell<dim>> cells) : list(std::move(cells)) {
  if (list.empty()) return;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Point<dim> low, high;
  for (int d = 0; d < dim; ++d) low[d] = infinity, high[d] = -infinity;
  box.resize(list.size());
  for (std::size_t c = 0; c < list.size(); ++c) {
    for (int d = 0; d < dim; ++d) box[c].low[d] = infinity, box[c].high[d] = -infinity;
    for (int v = 0; v < 1 << dim; ++v) {
      Point<dim> vertex;
      for (int m = 0; m < 1 << dim; ++m) {
        double factor = 1;
        for (int d = 0; d < dim; ++d)
          if (m >> d & 1) factor *= (v >> d & 1 ? 0.5 : -0.5) * (1 + 2 * list[c].reach);
        vertex += factor * list[c].coefficient[m];
      }
      for (int d = 0; d < dim; ++d) {
        box[c].low[d] = std::min(box[c].low[d], vertex[d]);
        box[c].high[d] = std::max(box[c].high[d], vertex[d]);
      }
    }
    for (int d = 0; d < dim; ++d) {
      low[d] = std::min(low[d], box[c].low[d]);
      high[d] = std::max(high[d], box[c].high[d]);
    }
  }
  // About one bin per four cells, of equal edges.
  origin = low;
  double volume = 1;
  for (int d = 0; d < dim; ++d) volume *= high[d] - low[d];
  const double edge = std::pow(4 * volume / list.size(), 1.0 / dim);
  std::size_t n_bins = 1;
  for (int d = 0; d < dim; ++d) {
    n[d] = std::clamp(static_cast<int>((high[d] - low[d]) / edge), 1, 1000);
    size[d] = (high[d] - low[d]) / n[d];
    inverse_size[d] = 1 / size[d];
    n_bins *= n[d];
  }
  std::vector<int> centres(n_bins, 0);
  for (const auto& cell : list) ++centres[flat(bin_of(Point<dim>(cell.coefficient[0])), n)];
  parts.resize(n_bins);
  leaf.resize(n_bins);
  std::uint32_t n_leaves = 0;
  for (std::size_t b = 0; b < n_bins; ++b) {
    // Parts of two thirds of a cell's width.
    parts[b] = std::clamp(static_cast<int>(std::ceil(1.5 * std::pow(centres[b], 1.0 / dim))), 1, 64);
    leaf[b] = n_leaves;
    n_leaves += static_cast<std::uint32_t>(std::lround(std::pow(parts[b], dim)));
  }
  first.assign(n_leaves + 1, 0);
  for (const Box& b : box)
    leaves_in(b.low, b.high, [&](std::size_t at, const Index&, const Index&) { ++first[at + 1]; });
  for (std::uint32_t k = 0; k < n_leaves; ++k) first[k + 1] += first[k];
  member.resize(first.back());
  std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
  for (std::uint32_t c = 0; c < box.size(); ++c)
    leaves_in(box[c].low, box[c].high,
              [&](std::size_t at, const Index&, const Index&) { member[next[at]++] = c; });
}

template <int dim>
typename CellBins<dim>::Index CellBins<dim>::bin_of(const Point<dim>& x) const {
  Index i;
  for (int d = 0; d < dim; ++d) {
    const double position = (x[d] - origin[d]) * inverse_size[d];
    i[d] = position <= 0 ? 0 : (position >= n[d] ? n[d] - 1 : static_cast<int>(position));
  }
  return i;
}

template <int dim>
typename CellBins<dim>::Index CellBins<dim>::part_of(const Point<dim>& x, const Index& bin, int count) const {
  Index i;
  for (int d = 0; d < dim; ++d) {
    const double position = ((x[d] - origin[d]) * inverse_size[d] - bin[d]) * count;
    i[d] = position <= 0 ? 0 : (position >= count ? count - 1 : static_cast<int>(position));
  }
  return i;
}

template <int dim>
void CellBins<dim>::search(const Point<dim>& x, Found& best) const {
  if (list.empty()) return;
  for (int d = 0; d < dim; ++d)
    if (!(x[d] >= origin[d] && x[d] <= origin[d] + n[d] * size[d])) return;
  const Index bin = bin_of(x);
  const std::size_t b = flat(bin, n);
  const std::size_t at = leaf[b] + flat(part_of(x, bin, parts[b]), cube(parts[b]));
  for (std::uint32_t k = first[at]; k < first[at + 1]; ++k) {
    const Box& around = box[member[k]];
    bool within = true;
    for (int d = 0; d < dim; ++d) within = within && x[d] >= around.low[d] && x[d] <= around.high[d];
    if (!within) continue;
    const MultilinearCell<dim>& cell = list[member[k]];
    const double outside = cell.outside(x);
    if (cell.alone && outside < -MultilinearCell<dim>::certainty) {
      best = {cell.number, outside, true};
      return;
    }
    if (outside <= cell.reach && outside < best.outside) best = {cell.number, outside, false};
  }
}

template <int dim>
std::size_t CellBins<dim>::memory_consumption() const {
  return list.capacity() * sizeof(MultilinearCell<dim>) + box.capacity() * sizeof(Box) +
         (parts.capacity() + leaf.capacity() + first.capacity() + member.capacity()) * sizeof(std::uint32_t) +
         sizeof(*this);
}

template struct MultilinearCell<2>;
template struct MultilinearCell<3>;
template class CellBins<2>;
template class CellBins<3>;

}  // namespace seedflow
