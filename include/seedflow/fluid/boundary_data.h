#pragma once

#include <deal.II/base/tensor.h>

#include <array>
#include <map>
#include <string>
#include <vector>

#include "seedflow/fluid/boundary_conditions.h"
#include "seedflow/fluid/nodal_space.h"
#include "seedflow/fluid/point_field.h"

namespace seedflow {

/// The boundary conditions on the nodes and faces of the present mesh.
/// Where sides meet, a node's velocity component follows the first of: wall, moving wall, velocity inlet,
/// slip, pressure inlet (its two components along the side); its force is counted for that side.
template <int dim, int degree>
class BoundaryData {
 public:
  using Vector = dealii::Tensor<1, dim>;
  using Space = NodalSpace<dim, degree>;
  struct Node {
    std::uint32_t node;  ///< owned
    int side;            ///< index into `names`
    dealii::Point<dim> position;
  };

  BoundaryData(const Space& space, const Domain<dim>& domain, const BoundaryConditions<dim>& conditions);

  std::vector<std::string> names;
  std::array<std::vector<Node>, dim> fixed_velocity;
  std::vector<Node> fixed_pressure;
  std::array<std::vector<char>, dim> velocity_fixed;  ///< per local node: given or constrained
  std::vector<char> pressure_fixed;
  bool has_open_side = false;  ///< anywhere, on any rank
  bool is_inlet(int side) const;
  bool is_open(int side) const;       ///< pressure inlet or outlet
  bool lets_through(int side) const;  ///< open, or with a given velocity that need not be along the side

  /// Writes `factor` times the given velocities into owned nodes.
  void set_velocity(double time, std::array<NodalVector, dim>& u, double factor = 1) const;
  void set_pressure(double time, NodalVector& p) const;

  /// y_i -= factor oint eps u.n q_i over sides of given velocity, u the nodal interpolant, eps extrapolated
  /// from the cell's quadrature points (from the nearest one where extrapolation leaves (0, 1]). Returns the
  /// inflow of this rank [m^dim/s] and adds the net outflow to that of each side, if given.
  double subtract_flux(const std::array<NodalVector, dim>& u, const PointField& void_fraction, NodalVector& y,
                       std::vector<double>* outflow = nullptr) const;
  /// -oint p n per side, this rank's faces.
  std::vector<Vector> pressure_force(const NodalVector& p) const;

 private:
  struct Face {
    std::uint32_t place;
    int side;
    std::vector<double> value;        ///< [q][i]
    std::vector<double> extrapolate;  ///< [q][cell point]
    std::vector<int> nearest;         ///< [q]
    std::vector<Vector> normal;       ///< n dA
  };
  struct NodeNormal {
    std::uint32_t node;
    int side;
    Vector normal;  ///< oint q_i n
  };
  const Space& space;
  std::vector<BoundaryCondition<dim>> condition;
  std::vector<Face> faces;
  std::vector<NodeNormal> normals;
};

}  // namespace seedflow
