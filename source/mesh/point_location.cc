#include "seedflow/mesh/point_location.h"

#include <cmath>
#include <stdexcept>

namespace seedflow {

using dealii::Point;
using dealii::Triangulation;

namespace {

/// Copies the tree below `cell` and returns the entry that stands for it.
template <int dim>
std::int32_t copy_tree(const typename Triangulation<dim>::cell_iterator& cell,
                       const std::vector<std::vector<std::int32_t>>& owned_number,
                       std::vector<std::int32_t>& node) {
  if (cell->is_active())
    return cell->is_locally_owned() ? -2 - owned_number[cell->level()][cell->index()] : -1;
  const std::size_t first = node.size();
  node.resize(first + (1u << dim), -1);
  for (unsigned int child = 0; child < (1u << dim); ++child) {
    const std::int32_t entry = copy_tree<dim>(cell->child(child), owned_number, node);
    node[first + child] = entry;
  }
  return static_cast<std::int32_t>(first);
}

}  // namespace

template <int dim>
void PointLocation<dim>::build(const Triangulation<dim>& triangulation, const Point<dim>& lower,
                               const Point<dim>& upper, const std::array<unsigned int, dim>& cells) {
  origin = lower;
  std::size_t n_roots = 1;
  for (int d = 0; d < dim; ++d) {
    coarse_cells[d] = static_cast<int>(cells[d]);
    coarse_size[d] = (upper[d] - lower[d]) / cells[d];
    inverse_coarse_size[d] = 1.0 / coarse_size[d];
    n_roots *= cells[d];
  }
  root.assign(n_roots, -1);
  node.clear();

  std::vector<std::vector<std::int32_t>> owned_number(triangulation.n_levels());
  for (unsigned int level = 0; level < triangulation.n_levels(); ++level)
    owned_number[level].assign(triangulation.n_raw_cells(level), -1);
  std::int32_t count = 0;
  for (const auto& cell : triangulation.active_cell_iterators())
    if (cell->is_locally_owned()) owned_number[cell->level()][cell->index()] = count++;

  std::size_t n_coarse = 0;
  for (const auto& cell : triangulation.cell_iterators_on_level(0)) {
    const auto offset = cell->center() - lower;
    std::size_t index = 0;
    for (int d = dim - 1; d >= 0; --d) {
      const double position = offset[d] * inverse_coarse_size[d];
      if (!(std::abs(position - std::floor(position) - 0.5) < 1e-6) || position < 0 || position > cells[d])
        throw std::logic_error(
            "PointLocation: the coarse mesh is not the box lattice it was announced to be");
      index = index * coarse_cells[d] + static_cast<int>(position);
    }
    root[index] = copy_tree<dim>(cell, owned_number, node);
    ++n_coarse;
  }
  if (n_coarse != n_roots) throw std::logic_error("PointLocation: the lattice has holes");
}

template <int dim>
int PointLocation<dim>::cell_of(const Point<dim>& point) const {
  std::array<double, dim> fraction;
  std::size_t index = 0;
  for (int d = dim - 1; d >= 0; --d) {
    const double position = (point[d] - origin[d]) * inverse_coarse_size[d];
    if (!(position >= 0.0 && position <= coarse_cells[d])) return not_here;
    int i = static_cast<int>(position);
    if (i == coarse_cells[d]) --i;  // the upper boundary belongs to the last cell
    fraction[d] = position - i;
    index = index * coarse_cells[d] + i;
  }
  std::int32_t entry = root[index];
  while (entry >= 0) {
    int child = 0;
    for (int d = 0; d < dim; ++d) {
      fraction[d] *= 2.0;
      const int upper = fraction[d] >= 1.0;
      fraction[d] -= upper;
      child |= upper << d;
    }
    entry = node[entry + child];
  }
  return leaf_to_cell(entry);
}

template class PointLocation<2>;
template class PointLocation<3>;

}  // namespace seedflow
