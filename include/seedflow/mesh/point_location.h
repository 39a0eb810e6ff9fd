#pragma once

#include <deal.II/base/point.h>
#include <deal.II/grid/tria.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "seedflow/mesh/cell_bins.h"
#include "seedflow/mesh/domain.h"

namespace seedflow {

/// Finds the locally owned cell of a point. Cells are numbered as in QuadratureLayout: locally owned active
/// cells in traversal order. Built once per mesh change; `./seedflow bench locate` measures it.
///
/// On a box mesh, a lattice of coarse cells each the root of an octree, the tree is copied into two flat
/// integer arrays: one look-up is a lattice division and one array read per refinement level. A point on a
/// face between two cells belongs to the one on its upper side; on the upper boundary of the box, to the last
/// cell. A point outside the box has no cell.
///
/// On any other mesh of hexahedra (quadrilaterals) with straight edges, the cells' bounding boxes are sorted
/// into bins and the trilinear map is inverted. A point on a face belongs to the first of its cells in the
/// mesh's hierarchical order. Where hanging nodes on a curved face leave a gap or an overlap, it belongs to
/// the cell that it is deepest in or nearest to. The same on any number of ranks: a rank knows its ghost
/// cells, too. (Points on the interface to a turning part may be found on both of its sides.)
template <int dim>
class PointLocation {
 public:
  static constexpr int not_here = -1;  ///< outside the mesh, or in a cell of another rank
  /// How far outside its cell, in parts of the width, a point in a gap at hanging nodes may lie.
  static constexpr double gap = 0.3;

  PointLocation() = default;

  /// For any mesh. The cells of the domain's rotor, if it has one, need not be built again when it turns.
  void build(const Domain<dim>& domain);
  /// The rotor stands at this angle now [rad], see Domain::angle().
  void turn_to(double angle);

  /// \param lower,upper corners of the box [m]; `coarse_cells` per direction. Throws std::logic_error if the
  /// triangulation's coarse cells do not form this lattice.
  void build(const dealii::Triangulation<dim>& triangulation, const dealii::Point<dim>& lower,
             const dealii::Point<dim>& upper, const std::array<unsigned int, dim>& coarse_cells);

  /// \param guess a cell that may well be the one, e.g. that of a point nearby; it is tried first.
  int cell_of(const dealii::Point<dim>& point, int guess = not_here) const;

  /// Calls visit(cell) for every locally owned cell that overlaps the axis-aligned box [low, high] (unless
  /// the mesh is a lattice: whose bounding box does, in a part that has turned a little more).
  template <typename Visit>
  void cells_in_box(const dealii::Point<dim>& low, const dealii::Point<dim>& high, const Visit& visit) const;

  std::size_t memory_consumption() const;

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

  /// Cells that move as one. The search takes place where they were at build().
  struct Part {
    CellBins<dim> bins;
    bool turned = false;
    dealii::Point<dim> centre;
    dealii::Tensor<2, dim> back;  ///< rotation from where they are to where they were
    dealii::Point<dim> before(const dealii::Point<dim>& x) const {
      return turned ? centre + back * (x - centre) : x;
    }
  };
  /// What decides in one cache line whether an owned cell surely holds a point: s = inverse (x - centre) is
  /// within the limit in every direction. Rounded to float, which the limit allows for.
  struct alignas(64) Glance {
    float inverse[dim][dim], centre[dim], limit = -1;
    std::uint32_t part = 0;
    bool holds(const dealii::Point<dim>& x) const {
      double largest = 0;
      for (int d = 0; d < dim; ++d) {
        double s = 0;
        for (int e = 0; e < dim; ++e) s += inverse[d][e] * (x[e] - centre[e]);
        largest = std::max(largest, std::abs(s));
      }
      return largest < limit;
    }
  };
  static Glance glance_at(const MultilinearCell<dim>& cell, std::uint32_t part);
  std::vector<Part> parts;  ///< empty: a lattice; the last is the rotor, if there is one
  std::optional<Rotor<dim>> rotor;
  double built_at = 0;         ///< angle of the rotor at build() [rad]
  std::vector<Glance> glance;  ///< of each owned cell
};

template <int dim>
template <typename Visit>
void PointLocation<dim>::cells_in_box(const dealii::Point<dim>& low, const dealii::Point<dim>& high,
                                      const Visit& visit) const {
  for (const Part& part : parts) {
    dealii::Point<dim> first = low, last = high;
    if (part.turned) {
      const dealii::Tensor<1, dim> half = 0.5 * (high - low);
      const dealii::Point<dim> middle = part.before(low + half);
      for (int d = 0; d < dim; ++d) {
        double reach = 0;
        for (int e = 0; e < dim; ++e) reach += std::abs(part.back[d][e]) * half[e];
        first[d] = middle[d] - reach;
        last[d] = middle[d] + reach;
      }
    }
    part.bins.in_box(first, last, [&](std::int32_t cell) {
      if (cell != not_here) visit(static_cast<int>(cell));
    });
  }
  if (!parts.empty()) return;
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
