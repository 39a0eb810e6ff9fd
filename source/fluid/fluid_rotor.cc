#include "cell_point.h"
#include "fluid_state.h"

namespace seedflow {

template <int dim, int degree>
void Fluid<dim, degree>::set_rotor_motion(const RotorMotion& motion) {
  auto& s = *implementation;
  if (!s.sliding) throw InputError("Air: no part of the mesh turns, so there is no rotor to move.");
  s.motion = motion;
  s.boundary->set_turning_speed(motion.speed);
}

template <int dim, int degree>
void Fluid<dim, degree>::turn_to(double angle) {
  auto& s = *implementation;
  if (!s.sliding) throw InputError("Air: no part of the mesh turns, so there is no rotor to turn.");
  if (angle == s.angle) return;
  s.turn_to(angle);
}

template <int dim, int degree>
std::array<double, 2> Fluid<dim, degree>::interface_flow() const {
  return implementation->interface_flow;
}

template <int dim, int degree>
void Fluid<dim, degree>::Implementation::turn_to(double new_angle) {
  const CpuTimer timer(statistics.turning);
  angle = new_angle;
  domain.turn_to(angle);
  space->turn_to(*domain.rotor(), angle);
  boundary->turn_to(*domain.rotor(), angle);
  boundary->set_turning_speed(motion.speed);
  sliding->turn_to(angle);
  // The multigrid stays until it no longer serves.
  if (multigrid_valid && preconditioned_values.empty()) preconditioned_values = pressure_matrix->value;
  momentum_matrix->set_patch(sliding->patch());
  pressure_matrix->set_patch(sliding->patch());
  patch_valid = false;
}

template <int dim, int degree>
void Fluid<dim, degree>::Implementation::lift(const NodalVector& p, PointField& jump) {
  if (!sliding) return;
  sliding->jump_gradient(p, jump);
}

template <int dim, int degree>
void Fluid<dim, degree>::Implementation::prepare_rotor() {
  if (!sliding) return;
  const CpuTimer timer(statistics.turning);
  const Rotor<dim>& rotor = *domain.rotor();
  const bool frozen = motion.mode == RotorMotion::Mode::frozen && motion.speed != 0;
  if (frozen && fields.source.is_uniform()) fields.source.resize(space->n_groups * n_q * dim, 0.0);
  const TimeScheme& scheme = coefficients.time;
  for (const auto& t : space->turning_groups())
    for (int q = 0; q < n_q; ++q) {
      const std::size_t k = t.group * n_q + q;
      for (int l = 0; l < W; ++l) {
        if (t.turns[l] == 0) continue;
        const auto& x = space->layout.position[std::size_t(space->cell[t.group * W + l]) * n_q + q];
        const Vector v = rotor.velocity(x, motion.speed);
        for (int d = 0; d < dim; ++d) fields.mesh_velocity.at(k * dim + d)[l] = v[d];
        if (!frozen) continue;
        Vector w;
        for (int d = 0; d < dim; ++d)
          w[d] = scheme.extrapolate_old * fields.u_old[k * dim + d][l] +
                 scheme.extrapolate_older * fields.u_older[k * dim + d][l];
        const Vector force = -coefficients.density * fields.eps[k][l] * motion.speed * rotor.across(w);
        for (int d = 0; d < dim; ++d) fields.source.at(k * dim + d)[l] += force[d];
      }
    }
  fields.p.update_ghost_values();
  space->set_constrained(fields.p);
  lift(fields.p, fields.jump_p);
}

template <int dim, int degree>
void Fluid<dim, degree>::Implementation::couple_momentum() {
  if (!sliding) return;
  const CpuTimer timer(statistics.turning);
  const TimeScheme& scheme = coefficients.time;
  interface_terms.density = coefficients.density;
  interface_terms.turning_speed = motion.speed;
  interface_terms.diffusion = sliding->share(
      1, [&](std::size_t k, int lane, int) { return fields.viscosity[k][lane] * fields.eps[k][lane]; });
  interface_terms.velocity = sliding->share(dim + 1, [&](std::size_t k, int lane, int d) {
    const double eps = fields.eps[k][lane];
    if (d == dim) return eps;
    return eps * (scheme.extrapolate_old * fields.u_old[k * dim + d][lane] +
                  scheme.extrapolate_older * fields.u_older[k * dim + d][lane]);
  });
  std::fill(momentum_matrix->patch_value.begin(), momentum_matrix->patch_value.end(), 0.0);
  sliding->add_momentum(interface_terms, *momentum_matrix, rhs);
}

template <int dim, int degree>
void Fluid<dim, degree>::Implementation::couple_pressure() {
  if (!sliding || patch_valid) return;
  const CpuTimer timer(statistics.turning);
  const auto c = sliding->share(1, [&](std::size_t k, int lane, int) {
    const Lanes eps = fields.eps[k];
    return (eps * coefficients.share(eps) / coefficients.inertia(eps, fields.beta[k]))[lane];
  });
  std::fill(pressure_matrix->patch_value.begin(), pressure_matrix->patch_value.end(), 0.0);
  sliding->add_diffusion(c, false, *pressure_matrix);
  patch_valid = true;
}

template <int dim, int degree>
void Fluid<dim, degree>::Implementation::subtract_interface_flux(const PointField& velocity, NodalVector& y) {
  if (!sliding) return;
  const CpuTimer timer(statistics.turning);
  sliding->subtract_flux(fields.eps, velocity, y);
  sliding->subtract_mesh_flux(fields.eps, motion.speed, y);
}

#define SEEDFLOW_ROTOR(dim, degree)                                                        \
  template void Fluid<dim, degree>::set_rotor_motion(const RotorMotion&);                  \
  template void Fluid<dim, degree>::turn_to(double);                                       \
  template std::array<double, 2> Fluid<dim, degree>::interface_flow() const;               \
  template void Fluid<dim, degree>::Implementation::turn_to(double);                       \
  template void Fluid<dim, degree>::Implementation::lift(const NodalVector&, PointField&); \
  template void Fluid<dim, degree>::Implementation::prepare_rotor();                       \
  template void Fluid<dim, degree>::Implementation::couple_momentum();                     \
  template void Fluid<dim, degree>::Implementation::couple_pressure();                     \
  template void Fluid<dim, degree>::Implementation::subtract_interface_flux(const PointField&, NodalVector&);
SEEDFLOW_ROTOR(2, 1)
SEEDFLOW_ROTOR(3, 1)
SEEDFLOW_ROTOR(2, 2)
SEEDFLOW_ROTOR(3, 2)

}  // namespace seedflow
