#pragma once

#include <array>
#include <memory>
#include <vector>

#include "seedflow/fluid/nodal_space.h"
#include "seedflow/fluid/point_field.h"
#include "seedflow/mesh/sliding_interface.h"

namespace seedflow {

/// What couples the nodal fields of rotor and stator across the sliding interface.
///
/// With [q] = q_rotor - q_stator, n and dA outward normal and area of the respective side, {} the mean of
/// both sides and values at the interface extrapolated from the quadrature points of the cells, the flux of a
/// field v given at the points through a cut piece is the one number
///   F = (v_rotor . n_rotor dA_rotor - v_stator . n_stator dA_stator) / 2,
/// and the divergence of v tested with q is int v.grad q - sum F [q]. Its negative transpose is the discrete
/// gradient G(q), which differs from grad q in the cells at the interface (lifting of the jump: Bassi & Rebay
/// 1997, doi:10.1006/jcph.1996.5572). Everything is built from G: the pressure force, the projection, and the
/// viscous terms. For Q_k cells G(q) = 0 only for constants, because the lifting has a part of degree k
/// across the cell that grad q cannot have; so no penalty is needed. On a cylinder the chords of the two
/// sides leave slivers between them; sum over both sides of int psi d{q}/ds / 2, with psi the stream function
/// of {v} across the sliver, carries what flows along it, so that a constant v has no divergence at all.
///
/// Parts of faces without partner are walls. For a field with walls, its difference from the wall's is lifted
/// in the same way (Nitsche's condition without a parameter).
///
/// Cells at the interface are known to all ranks; each computes the rows of its own nodes.
template <int dim, int degree>
class SlidingCoupling {
 public:
  using Space = NodalSpace<dim, degree>;
  using Vector = dealii::Tensor<1, dim>;
  static constexpr int n = Space::n, n_q = Space::n_q, n_face = power(degree + 1, dim - 1),
                       n_line = degree + 1;

  /// `space` at angle 0; turn_to() must follow.
  SlidingCoupling(const Space& space, const Domain<dim>& domain);

  void turn_to(double angle);
  const SlidingInterface<dim>& interface() const { return *faces; }
  std::shared_ptr<const PatchStructure> patch() const { return places; }

  /// G(p) - grad p at the points [(group n_q + point) dim + component]; ghosts of p must be current.
  void jump_gradient(const NodalVector& p, PointField& jump) const;
  /// y_i -= sum over pieces of the flux of eps v times [q_i], v as above [(group n_q + point) dim +
  /// component].
  void subtract_flux(const PointField& eps, const PointField& v, NodalVector& y) const;
  /// The flux of eps v out of the rotor and into the stator, each summed over its own side's test functions;
  /// all ranks.
  std::array<double, 2> flow(const PointField& eps, const PointField& v) const;

  /// Coefficients at the points of all cells at the interface [(cell n_q + point) n_components + component],
  /// from those of this rank, value(group n_q + point, lane, component). Collective.
  template <typename Value>
  std::vector<double> share(int n_components, const Value& value) const;

  /// Adds int c (G q_i . G q_j - grad q_i . grad q_j) to the patch, c from share(); with walls as for a
  /// velocity or without as for a pressure.
  void add_diffusion(const std::vector<double>& c, bool walls, SparseMatrix& matrix) const;

  /// The momentum equation's terms at the interface, into the patch of the matrix and the right-hand sides:
  /// int c G u . G v less its part within the cells, convection rho [F {u} + |F| [u] / 2] [v] with the flux F
  /// of eps w (central plus upwind), and at walls rho |eps w.n| (u - u_wall) v beside the lifted condition.
  /// `turning_speed` [rad/s] gives the velocity of walls that turn; the rotor's cells are left relative to
  /// it.
  struct Momentum {
    double density;
    double turning_speed;
    std::vector<double> diffusion;  ///< eps mu, from share() with one component
    std::vector<double> velocity;   ///< eps w, from share() with dim components, then eps
  };
  void add_momentum(const Momentum& terms, SparseMatrix& matrix, std::array<NodalVector, dim>& rhs) const;
  /// What the walls of either side (rotor, stator) do to the air by shear, of this rank's cells [N].
  std::array<Vector, 2> wall_force(const Momentum& terms, const std::array<NodalVector, dim>& u) const;
  /// y_i += flux of eps times the rotor's velocity through its own faces at the interface, times q_i: what a
  /// divergence relative to the rotor must not count. Zero but on cylinders, whose chords are not arcs.
  /// Collective.
  void subtract_mesh_flux(const PointField& eps, double turning_speed, NodalVector& y) const;
  /// -int p n over the walls of either side, of this rank's cells.
  std::array<Vector, 2> wall_pressure(const NodalVector& p) const;

 private:
  struct Cell {
    bool turns;
    bool needed = false;                               ///< touches an owned node
    std::int32_t place = -1;                           ///< on this rank: group W + lane
    std::vector<std::uint32_t> first, node, own_slot;  ///< masters of shape function i: first[i]..first[i+1]
    std::vector<double> weight;
    std::array<dealii::Point<dim>, 1 << dim> vertex;  ///< at angle 0
    std::vector<double> gradient;                     ///< [q][d][i], at angle 0
    std::array<double, n_q> JxW;
    std::vector<std::uint32_t> faces;
    // At the present angle:
    std::vector<std::uint32_t> slot;      ///< local numbers of all nodes it couples, its own first
    std::vector<double> lift;             ///< [q][d][slot]: G = grad - lift / JxW
    std::array<bool, dim> lifts{};        ///< whether any of it is not zero, per direction
    std::vector<double> wall;             ///< [q][d][slot]; empty: no walls
    std::vector<std::uint32_t> position;  ///< [slot][slot] in the patch, rows of owned nodes
  };
  /// Face moments of a piece: int T_a q_i for T of the Gauss points and q of the nodes of a face.
  using Moments = std::array<double, n_face * n_face>;
  struct PieceMoments {
    Moments own[2], other[2];
    std::array<Moments, dim> sliver_own[2], sliver_other[2];
  };

  void gather(const Domain<dim>& domain);
  void compute_moments();
  void compute_lifting(Cell& cell);
  void compute_walls(Cell& cell);
  void build_patch();
  /// Values at a point of a face: of the Lagrange polynomials of the Gauss points and of the nodes, the
  /// latter's derivatives along `direction` of the reference coordinates.
  struct FaceValues {
    double test[n_face], node[n_face], slope[n_face];
  };
  FaceValues face_values(std::uint32_t face, const dealii::Point<dim - 1>& x) const;
  void set_corrections();
  /// int c (G.G - grad.grad) of one cell on its slots.
  void diffusion_of(std::uint32_t cell, const double* c, bool walls, std::vector<double>& local) const;
  /// Derivatives along d at point q of the shape functions, on the slots of a cell; the second with lifting.
  void gradient_on_slots(const Cell& cell, int q, int d, std::vector<double>& g) const;
  void discrete_gradient(const Cell& cell, int q, int d, std::vector<double>& h) const;
  struct Walls {
    struct Node {
      int i;           ///< shape function of the cell
      double penalty;  ///< rho |eps w.n| times its share of the walls
      Vector velocity;
    };
    std::vector<Node> nodes;
    std::vector<Vector> lifted;  ///< of the wall's velocity, [q dim + d]
  };
  Walls walls_of(std::uint32_t cell, const Momentum& terms) const;
  Vector wall_velocity(std::uint32_t face, int corner, double speed) const;
  std::array<Vector, n_face> trace(std::uint32_t face, const std::vector<double>& v) const;
  std::array<Vector, n_face> trace_of_turning(std::uint32_t face, const Momentum& terms) const;
  /// Convection through a piece on the nodes of both its faces, the rotor's first: [2 n_face][2 n_face].
  void add_convection(std::uint32_t piece, const Momentum& terms, double* local) const;
  Vector mesh_momentum(std::uint32_t cell, const Momentum& terms,
                       const std::array<NodalVector, dim>& u) const;
  /// The slots of a cell that the nodes of a piece stand for.
  std::array<std::vector<std::pair<std::uint32_t, double>>, 2 * n_face> slots_of_piece(
      std::uint32_t cell, std::uint32_t piece) const;
  void add_to_patch(std::uint32_t cell, const std::vector<double>& local, SparseMatrix& matrix) const;
  Vector sliver_flux(const typename SlidingInterface<dim>::Piece& piece,
                     const typename SlidingInterface<dim>::Point& point) const;

  const Space& space;
  std::unique_ptr<SlidingInterface<dim>> faces;
  std::vector<Cell> cells;
  std::vector<std::uint32_t> cell_of_face;
  std::vector<std::vector<std::uint32_t>> pieces_of_face;
  std::vector<PieceMoments> moments;
  /// Of each face at the present angle: outward n dA per parameter area, derivative along the arc, and what
  /// is added to the values of each node so that their integrals over a face with partners everywhere are
  /// exact although the quadrature on pieces of general quadrilaterals is not.
  std::vector<typename SlidingInterface<dim>::FacePoint> frame;
  std::vector<std::array<double, n_face>> correction;
  std::shared_ptr<PatchStructure> places;
  dealii::Tensor<2, dim> rotation;                    ///< from angle 0 to the present
  std::vector<int> first_of_rank;                     ///< cells of each rank
  std::vector<Moments> wall_moments;                  ///< int T_a q_i over the walls of each face
  std::vector<std::array<double, n_face>> wall_area;  ///< int q_i over the walls of each face
  double linear_value[n_q][1 << dim];                 ///< of the multilinear map at the points
  std::array<double, n_line> line_node, line_gauss;
  std::array<double, n_line> end_value[2];  ///< of the Lagrange polynomials of the Gauss points at 0 and 1
  std::array<std::array<int, n_face>, 2 * dim> node_of_face;  ///< shape functions of each face, lexicographic
  std::array<std::array<int, n_face * n_line>, 2 * dim> point_of_face;  ///< point at face point a, depth b
};

template <int dim, int degree>
template <typename Value>
std::vector<double> SlidingCoupling<dim, degree>::share(int n_components, const Value& value) const {
  const MPI_Comm comm = space.structure->partitioner->get_mpi_communicator();
  const int rank = dealii::Utilities::MPI::this_mpi_process(comm), per_cell = n_q * n_components;
  std::vector<double> all(cells.size() * per_cell);
  for (int c = first_of_rank[rank]; c < first_of_rank[rank + 1]; ++c)
    for (int q = 0; q < n_q; ++q)
      for (int k = 0; k < n_components; ++k)
        all[c * per_cell + q * n_components + k] =
            value(std::size_t(cells[c].place / Space::W) * n_q + q, cells[c].place % Space::W, k);
  const int n_ranks = first_of_rank.size() - 1;
  if (n_ranks == 1) return all;
  std::vector<int> count(n_ranks), offset(n_ranks);
  for (int r = 0; r < n_ranks; ++r) {
    count[r] = (first_of_rank[r + 1] - first_of_rank[r]) * per_cell;
    offset[r] = first_of_rank[r] * per_cell;
  }
  MPI_Allgatherv(MPI_IN_PLACE, 0, MPI_DATATYPE_NULL, all.data(), count.data(), offset.data(), MPI_DOUBLE,
                 comm);
  return all;
}

}  // namespace seedflow
