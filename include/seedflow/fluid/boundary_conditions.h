#pragma once

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <functional>
#include <map>
#include <string>

#include "seedflow/mesh/domain.h"

namespace seedflow {

/// What happens at one side of the air domain.
///   wall            u = 0
///   moving wall     u = given velocity
///   rotor wall      u = velocity of the turning rotor there (of either part of the mesh)
///   velocity inlet  u = given velocity
///   pressure outlet p = given pressure; fluid that enters through it brings no momentum
///   pressure inlet  p = given pressure, no velocity along the side; entering fluid brings its own momentum
///   slip            u.n = 0, no shear (the side must be perpendicular to an axis)
///   periodic        joined to the opposite side by the domain
enum class BoundaryType {
  wall,
  moving_wall,
  rotor_wall,
  velocity_inlet,
  pressure_outlet,
  pressure_inlet,
  slip,
  periodic
};

template <int dim>
struct BoundaryCondition {
  BoundaryType type = BoundaryType::wall;
  std::function<dealii::Tensor<1, dim>(const dealii::Point<dim>&, double)>
      velocity;                                                       ///< (x [m], t [s]) -> [m/s]
  std::function<double(const dealii::Point<dim>&, double)> pressure;  ///< (x [m], t [s]) -> [Pa]
};

/// Side name -> condition. Every side of the domain must have one (periodic sides may be left out; sides of a
/// sliding interface have none).
template <int dim>
using BoundaryConditions = std::map<std::string, BoundaryCondition<dim>>;

/// Reads conditions as the user writes them: entries `name: type, values` separated by semicolons, e.g.
///   left: velocity inlet, 4*y*(1-y), 0, 0; right: pressure outlet, 0; top: moving wall, 1, 0, 0; *: wall
/// Values are numbers or expressions in x, y, z, t (SI); a pressure left out is 0; `*` stands for all sides
/// not named. Errors: InputError for an unknown side or type, a wrong number of values, a malformed
/// expression, a side without condition or named twice.
template <int dim>
BoundaryConditions<dim> parse_boundary_conditions(const std::string& text, const Domain<dim>& domain);

/// Errors: InputError if a side of the domain has no condition, a condition names no side, or a value is
/// missing.
template <int dim>
void check_boundary_conditions(const BoundaryConditions<dim>& conditions, const Domain<dim>& domain);

}  // namespace seedflow
