// What is booked at the end of a step: mass, momentum, and what passes each side.

#include <cmath>

#include "fluid_state.h"
#include "rank_sums.h"

namespace seedflow {

template <int dim, int degree>
void Fluid<dim, degree>::Implementation::book_mass(const StepIntegrals<dim>& integrals, double inflow) {
  double outflow = 0, total = 0, largest = 0, growth = integrals.growth, circulation = integrals.circulation;
  std::vector<double> side_power(boundary->names.size(), 0.0);
  // At open sides the residuals are the outflow.
  std::vector<char> open(space->structure->n_owned(), 0);
  for (const auto& node : boundary->fixed_pressure) {
    const double out = scalar_rhs.local_element(node.node);
    open[node.node] = 1;
    side_outflow[node.side] += out;
    side_power[node.side] += out * fields.p.local_element(node.node);
  }
  for (std::uint32_t i = 0; i < open.size(); ++i) {
    const double r = scalar_rhs.local_element(i);
    if (space->constrained[i]) continue;
    if (open[i]) {
      outflow += std::max(0.0, -r);
    } else {
      largest = std::isfinite(r) ? std::max(largest, std::abs(r)) : INFINITY;
      total += r;
    }
  }
  RankSums sums;
  for (double* x : {&inflow, &outflow, &growth, &circulation, &total}) sums.include(*x);
  sums.include(side_outflow);
  sums.include(side_power);
  sums.sum(domain.communicator());
  largest = max(largest);
  if (!std::isfinite(largest)) fail("the flow is not finite.", "Reduce the time step.");

  for (std::size_t side = 0; side < side_power.size(); ++side) {
    const auto& name = boundary->names[side];
    if (boundary->lets_through(side)) mass.outflow[name] = side_outflow[side];
    if (boundary->is_open(side)) mass.power[name] = side_power[side];
  }
  mass.flow =
      std::max({inflow, outflow, growth, circulation / std::pow(domain_volume, 1.0 / dim), smallest_flow()});
  mass.largest = mass.flow > 0 ? largest / mass.flow : 0;
  mass.total = mass.flow > 0 ? std::abs(total) / mass.flow : 0;
}

template <int dim, int degree>
void Fluid<dim, degree>::Implementation::book_reactions() {
  const std::size_t n_sides = boundary->names.size();
  std::vector<Vector> reaction(n_sides);
  std::vector<double> torque(n_sides, 0.0);
  for (int d = 0; d < dim; ++d) {
    for (const auto& node : boundary->fixed_velocity[d]) {
      const double force =
          momentum_matrix->row_times(node.node, fields.u[d]) - rhs[d].local_element(node.node);
      reaction[node.side][d] += force;
      if (sliding)
        torque[node.side] += force * domain.rotor()->across(node.position - domain.rotor()->centre)[d];
    }
    for (const auto& node : boundary->fixed_pressure)
      reaction[node.side][d] -= mass_defect.local_element(node.node) * fields.u[d].local_element(node.node);
  }
  auto& balance = momentum_balance;
  const std::vector<Vector> pressure = boundary->pressure_force(fields.p);
  for (std::size_t side = 0; side < n_sides; ++side) {
    balance.reaction[boundary->names[side]] = reaction[side];
    balance.pressure_force[boundary->names[side]] = pressure[side];
  }
  if (!sliding) return;
  const auto moment = boundary->turning_moment();
  for (std::size_t side = 0; side < n_sides; ++side)
    balance.torque[boundary->names[side]] =
        torque[side] - coefficients.viscosity * motion.speed * moment[side];
  const auto& pair = domain.rotor()->pairs.front();
  const auto shear = sliding->wall_force(interface_terms, fields.u);
  const auto normal = sliding->wall_pressure(fields.p);
  balance.reaction[pair.rotor] = shear[0], balance.reaction[pair.stator] = shear[1];
  balance.pressure_force[pair.rotor] = normal[0], balance.pressure_force[pair.stator] = normal[1];
}

template <int dim, int degree>
void Fluid<dim, degree>::Implementation::book_momentum(const StepIntegrals<dim>& integrals) {
  const auto vector = [](const double(&a)[dim]) {
    Vector v;
    for (int d = 0; d < dim; ++d) v[d] = a[d];
    return v;
  };
  auto& balance = momentum_balance;
  balance.change = vector(integrals.change);
  balance.exchange = vector(integrals.exchange);
  balance.pressure = vector(integrals.pressure);
  balance.pressure_share = vector(integrals.share);
  momentum = vector(integrals.momentum);
  book_reactions();

  RankSums sums;
  for (Vector* v :
       {&balance.change, &balance.exchange, &balance.pressure, &balance.pressure_share, &momentum})
    sums.include(*v);
  for (auto* forces : {&balance.reaction, &balance.pressure_force})
    for (auto& [side, force] : *forces) sums.include(force);
  for (auto& [side, torque] : balance.torque) sums.include(torque);
  sums.sum(domain.communicator());
  if (!std::isfinite(momentum.norm())) fail("the flow is not finite.", "Reduce the time step.");

  Vector left = balance.change - balance.exchange - balance.pressure;
  double scale = std::max({balance.change.norm(), balance.exchange.norm(), balance.pressure.norm()});
  for (const auto& [side, force] : balance.reaction) {
    left -= force;
    scale = std::max(scale, force.norm());
  }
  for (const auto& [side, force] : balance.pressure_force) scale = std::max(scale, force.norm());
  balance.residual = scale > 0 ? left.norm() / scale : 0;
}

template <int dim, int degree>
void Fluid<dim, degree>::Implementation::centre_pressure() {
  if (boundary->has_open_side) return;
  double nodes = 0, total = 0;
  for (std::uint32_t i = 0; i < space->structure->n_owned(); ++i)
    if (!space->constrained[i]) {
      nodes += 1;
      total += fields.p.local_element(i);
    }
  RankSums sums;
  sums.include(nodes);
  sums.include(total);
  sums.sum(domain.communicator());
  fields.p.zero_out_ghost_values();
  fields.p.add(-total / nodes);
  fields.p.update_ghost_values();
}

#define SEEDFLOW_BALANCE(dim, degree)                                                             \
  template void Fluid<dim, degree>::Implementation::book_mass(const StepIntegrals<dim>&, double); \
  template void Fluid<dim, degree>::Implementation::book_reactions();                             \
  template void Fluid<dim, degree>::Implementation::book_momentum(const StepIntegrals<dim>&);     \
  template void Fluid<dim, degree>::Implementation::centre_pressure();
SEEDFLOW_BALANCE(2, 1)
SEEDFLOW_BALANCE(3, 1)
SEEDFLOW_BALANCE(2, 2)
SEEDFLOW_BALANCE(3, 2)

}  // namespace seedflow
