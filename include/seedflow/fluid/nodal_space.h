#pragma once

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/lac/affine_constraints.h>

#include <cstdint>
#include <memory>
#include <vector>

#include "seedflow/fluid/element.h"
#include "seedflow/fluid/sparse_matrix.h"
#include "seedflow/mesh/domain.h"
#include "seedflow/mesh/quadrature_layout.h"

namespace seedflow {

/// The Q_k space shared by the velocity components and the pressure, prepared for kernels that treat
/// lane_width cells at once: lane = cell. Groups of cells whose nodes are all free come first; they are
/// scattered through a table of positions. Cells with hanging or periodic nodes follow; what they add goes to
/// the nodes that constrain them. Groups follow the Z order of the cells, so that sums are formed in an order
/// that depends on the mesh alone. Unused lanes of a group repeat its first cell with weight zero.
template <int dim, int degree>
class NodalSpace {
 public:
  using Shape = Element<dim, degree>;
  static constexpr int W = lane_width, n = Shape::n, n_q = Shape::n_q;

  explicit NodalSpace(const Domain<dim>& domain);
  /// Again, on the domain's changed mesh.
  void rebuild(const Domain<dim>& domain);

  Shape shape;
  dealii::FE_Q<dim> fe;
  dealii::DoFHandler<dim> dofs;
  dealii::AffineConstraints<double> constraints;
  std::shared_ptr<const SparsityStructure> structure;
  QuadratureLayout<dim> layout;

  std::size_t n_groups, n_free_groups;
  std::vector<std::uint32_t> node;   ///< [(group n + i) W + lane], local numbers
  std::vector<std::uint32_t> cell;   ///< [group W + lane], cell of `layout`
  std::vector<std::uint8_t> used;    ///< lanes in use, per group
  std::vector<std::uint32_t> place;  ///< [cell]: group W + lane
  std::vector<char> constrained;     ///< per local node

  void initialize(NodalVector& v) const { v.reinit(structure->partitioner); }

  SEEDFLOW_INLINE void gather(const NodalVector& x, std::size_t group, Lanes* out) const {
    const std::uint32_t* index = node.data() + group * n * W;
    const double* value = x.begin();
    for (int i = 0; i < n; ++i) {
      Lanes v{};
      for (int l = 0; l < W; ++l) v[l] = value[index[i * W + l]];
      out[i] = v;
    }
  }
  /// Adds to the nodes (of constrained nodes: to those that constrain them).
  void scatter(const Lanes* in, std::size_t group, NodalVector& y) const;
  void scatter(const Lanes* in, std::size_t group, SparseMatrix& matrix) const;

  /// The same for one cell, `at` = place[cell].
  void add(const double* in, std::uint32_t at, NodalVector& y) const;

  /// d(xi_e)/d(x_d) at point q is inverse_jacobian(group, q)[e dim + d]; the weight includes the Jacobian.
  SEEDFLOW_INLINE const Lanes* inverse_jacobian(std::size_t group, int q) const {
    return jacobian.data() + (first_jacobian[group] + q * jacobian_stride[group]) * (dim * dim + 1);
  }
  SEEDFLOW_INLINE Lanes weight(std::size_t group, int q) const {
    return inverse_jacobian(group, q)[dim * dim] * shape.weight[q];
  }

  /// With a rotor in the domain: its cells as they are at this angle [rad], from the angle 0 at which the
  /// space is built. All nodes of all cells at the sliding interface are ghosts on every rank, so that
  /// numbers stay when the rotor turns.
  void turn_to(const Rotor<dim>& rotor, double angle);
  /// 1 in the lanes of cells that turn, for each group that has any.
  struct TurningGroup {
    std::uint32_t group;
    Lanes turns;
  };
  const std::vector<TurningGroup>& turning_groups() const { return turning; }
  /// The nodes that shape function i of a cell stands for, and how much: several at a hanging node.
  std::vector<std::pair<std::uint32_t, double>> masters(std::uint32_t at, int i) const;

  /// Gives hanging and periodic nodes the values their constraints ask for; ghosts must be current.
  void set_constrained(NodalVector& x) const;

  double bytes() const;

 private:
  struct ConstrainedCell {
    std::vector<std::uint32_t> masters, positions;  ///< positions: masters x masters in the matrix
    std::vector<double> weight;                     ///< n x masters
  };
  struct Line {
    std::uint32_t node;
    std::vector<std::pair<std::uint32_t, double>> entries;
  };
  void number_nodes(const Domain<dim>& domain);
  void group_cells(const Domain<dim>& domain);
  void compute_geometry(const Domain<dim>& domain);

  std::vector<Lanes> jacobian;
  std::vector<std::uint32_t> first_jacobian;
  std::vector<std::uint8_t> jacobian_stride;       ///< 0 where the cells of a group are parallelepipeds
  std::vector<std::uint32_t> position;             ///< [((group n + i) n + j) W + lane], free groups
  std::vector<ConstrainedCell> constrained_cells;  ///< [(group - n_free_groups) W + lane]
  dealii::IndexSet nodes_at_interface(const Domain<dim>& domain) const;
  void find_turning_cells(const Domain<dim>& domain);
  std::vector<TurningGroup> turning;
  std::vector<Lanes> jacobian_at_rest;  ///< of the turning groups
  std::vector<std::pair<std::uint32_t, dealii::Point<dim>>>
      position_at_rest;  ///< of their points in `layout`
  std::vector<Line> lines;
};

}  // namespace seedflow
