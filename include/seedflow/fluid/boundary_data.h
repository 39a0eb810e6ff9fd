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
    bool turns = false;  ///< with the rotor
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

  /// With a rotor: its sides at this angle [rad], from 0 where they were found, and its angular velocity
  /// [rad/s].
  void turn_to(const Rotor<dim>& rotor, double angle);
  void set_turning_speed(double speed) { turning_speed = speed; }

  /// Writes `factor` times the given velocities into owned nodes.
  void set_velocity(double time, std::array<NodalVector, dim>& u, double factor = 1) const;
  void set_pressure(double time, NodalVector& p) const;

  /// y_i -= oint eps u.n q_i over sides of given velocity (relative to the rotor on its own sides), u the
  /// nodal interpolant, eps extrapolated from the cell's quadrature points (from the nearest one where
  /// extrapolation leaves (0, 1]). Returns the inflow of this rank [m^dim/s] and adds the net outflow to that
  /// of each side, if given.
  double subtract_flux(const std::array<NodalVector, dim>& u, const PointField& void_fraction, NodalVector& y,
                       std::vector<double>* outflow = nullptr) const;
  /// -oint p n per side, this rank's faces.
  std::vector<Vector> pressure_force(const NodalVector& p) const;
  /// oint (r.n - (r.a)(n.a)) per side of type rotor wall, r from the axis a, this rank's faces: mu omega
  /// times it is the moment of (grad u)^T n, which the Laplacian form of the viscous stress leaves out. (u
  /// less the turning vanishes on such a wall, so there (grad u)^T n = - omega x n for incompressible flow.)
  std::vector<double> turning_moment() const;

 private:
  struct Face {
    std::uint32_t place;
    int side;
    std::vector<double> value;        ///< [q][i]
    std::vector<double> extrapolate;  ///< [q][cell point]
    std::vector<int> nearest;         ///< [q]
    std::vector<Vector> normal;       ///< n dA
    bool turns = false;
    std::vector<dealii::Point<dim>> position;  ///< [q], if it turns
  };
  struct NodeNormal {
    std::uint32_t node;
    int side;
    Vector normal;  ///< oint q_i n
    bool turns = false;
    dealii::Point<dim> position;
  };
  const Space& space;
  std::vector<BoundaryCondition<dim>> condition;
  std::vector<Face> faces;
  std::vector<NodeNormal> normals;

  template <typename Visit>
  void visit_turning(const Visit& visit);  ///< point, vector: everything that turns, in one order
  Rotor<dim> rotor;
  bool has_rotor = false;
  double turning_speed = 0;
  std::vector<dealii::Point<dim>> points_at_rest;
  std::vector<Vector> vectors_at_rest;
};

}  // namespace seedflow
