#pragma once

#include <deal.II/base/point.h>
#include <deal.II/grid/tria.h>

#include <array>
#include <cstdint>
#include <vector>

namespace seedflow {

/// Finds the locally owned cell of a point on a box mesh: a lattice of coarse cells, each the root of an
/// octree. The tree is copied into two flat integer arrays once per mesh change, so that one look-up is a
/// lattice division and one array read per refinement level (tens of nanoseconds, see `./seedflow bench
/// locate`).
///
/// Cells are numbered as in QuadratureLayout: locally owned active cells in traversal order.
/// A point on a face between two cells belongs to the one on its upper side; on the upper boundary of the
/// box, to the last cell. A point outside the box has no cell.
template <int dim>
class PointLocation {
 public:
  static constexpr int not_here = -1;  ///< outside the box, or in a cell of another rank

  PointLocation() = default;

  /// \param lower,upper corners of the box [m]; `coarse_cells` per direction. Throws std::logic_error if the
  /// triangulation's coarse cells do not form this lattice.
  void build(const dealii::Triangulation<dim>& triangulation, const dealii::Point<dim>& lower,
             const dealii::Point<dim>& upper, const std::array<unsigned int, dim>& coarse_cells);

  int cell_of(const dealii::Point<dim>& point) const;

  /// Calls visit(cell) for every locally owned cell that overlaps the axis-aligned box [low, high].
  template <typename Visit>
  void cells_in_box(const dealii::Point<dim>& low, const dealii::Point<dim>& high, const Visit& visit) const;

  std::size_t memory_consumption() const {
    return (root.capacity() + node.capacity()) * sizeof(std::int32_t) + sizeof(*this);
  }

 private:
  // A node >= 0 is the index of the first of 2^dim children in `node`; a node < 0 is a leaf: -1 means not
  // owned, -2 - c is the owned cell c.
  static int leaf_to_cell(std::int32_t leaf) { return leaf == -1 ? not_here : -2 - leaf; }
  template <typename Visit>
  void visit_node(std::int32_t entry, const dealii::Point<dim>& corner, const dealii::Tensor<1, dim>& size,
                  const dealii::Point<dim>& low, const dealii::Point<dim>& high, const Visit& visit) const;

  dealii::Point<dim> origin;
  dealii::Tensor<1, dim> coarse_size, inverse_coarse_size;
  std::array<int, dim> coarse_cells{};
  std::vector<std::int32_t> root;  ///< one entry per coarse cell, x fastest
  std::vector<std::int32_t> node;  ///< children, 2^dim in a row, x fastest
};

template <int dim>
template <typename Visit>
void PointLocation<dim>::cells_in_box(const dealii::Point<dim>& low, const dealii::Point<dim>& high,
                                      const Visit& visit) const {
  std::array<int, 3> first{}, last{};
  for (int d = 0; d < dim; ++d) {
    const double a = (low[d] - origin[d]) * inverse_coarse_size[d],
                 b = (high[d] - origin[d]) * inverse_coarse_size[d];
    first[d] = a <= 0 ? 0 : static_cast<int>(a);
    last[d] = b < 0 ? -1 : (b >= coarse_cells[d] ? coarse_cells[d] - 1 : static_cast<int>(b));
  }
  std::array<int, 3> i = first;
  for (i[2] = first[2]; i[2] <= last[2]; ++i[2])
    for (i[1] = first[1]; i[1] <= last[1]; ++i[1])
      for (i[0] = first[0]; i[0] <= last[0]; ++i[0]) {
        std::size_t index = 0;
        dealii::Point<dim> corner = origin;
        for (int d = dim - 1; d >= 0; --d) {
          index = index * coarse_cells[d] + i[d];
          corner[d] += i[d] * coarse_size[d];
        }
        visit_node(root[index], corner, coarse_size, low, high, visit);
      }
}

template <int dim>
template <typename Visit>
void PointLocation<dim>::visit_node(std::int32_t entry, const dealii::Point<dim>& corner,
                                    const dealii::Tensor<1, dim>& size, const dealii::Point<dim>& low,
                                    const dealii::Point<dim>& high, const Visit& visit) const {
  if (entry == -1) return;
  for (int d = 0; d < dim; ++d)
    if (corner[d] > high[d] || corner[d] + size[d] < low[d]) return;
  if (entry < 0) {
    visit(leaf_to_cell(entry));
    return;
  }
  const dealii::Tensor<1, dim> half = 0.5 * size;
  for (unsigned int child = 0; child < (1u << dim); ++child) {
    dealii::Point<dim> child_corner = corner;
    for (int d = 0; d < dim; ++d)
      if (child >> d & 1u) child_corner[d] += half[d];
    visit_node(node[entry + child], child_corner, half, low, high, visit);
  }
}

}  // namespace seedflow
