#pragma once

#include <array>
#include <cmath>

#include "seedflow/fluid/fluid.h"

namespace seedflow {

/// A flow that solves the volume-averaged equations with a force made for it, in the closed unit square or
/// cube: the void fraction varies in space and time, eps u = curl(psi) + grad(chi) with laplace(chi) =
/// -d(eps)/dt has no component across the boundary. The force comes from fourth-order differences (error
/// below 1e-7), not from the solver's own formulas.
template <int dim>
struct Manufactured {
  using Vector = dealii::Tensor<1, dim>;
  using Point = dealii::Point<dim>;
  double density = 1.3, viscosity = 0.05, drag = 2, omega = 3, amplitude = 0.15;
  bool model_a = true;
  std::string subscales = "quasi-static", viscous_stress = "laplacian";

  static constexpr double pi = 3.14159265358979323846;

  double eps(const Point& x, double t) const {
    double c = amplitude * std::cos(omega * t);
    for (int d = 0; d < dim; ++d) c *= std::cos(pi * x[d]);
    return 0.7 + c;
  }
  Vector velocity(const Point& x, double t) const {
    const double g = 1 + 0.5 * std::sin(omega * t);
    double z = 1;
    if (dim == 3) z = std::cos(pi * x[dim - 1]);
    const double sx = std::sin(pi * x[0]), cx = std::cos(pi * x[0]), sy = std::sin(pi * x[1]),
                 cy = std::cos(pi * x[1]);
    Vector f;
    f[0] = g * z * sx * sx * sy * cy;
    f[1] = -g * z * sx * cx * sy * sy;
    // grad(chi), chi = d(eps)/dt / (dim pi^2)
    for (int d = 0; d < dim; ++d) {
      double a = -amplitude * omega * std::sin(omega * t) / (dim * pi);
      for (int e = 0; e < dim; ++e) a *= e == d ? -std::sin(pi * x[e]) : std::cos(pi * x[e]);
      f[d] += a;
    }
    return f / eps(x, t);
  }
  double pressure(const Point& x, double t) const {
    double p = (1 + 0.5 * std::sin(t)) * std::cos(pi * x[0]) * std::sin(pi * x[1]);
    if (dim == 3) p *= std::cos(pi * x[2]);
    return p;
  }

  template <typename F>
  static auto difference(const F& f, double h) {
    return (8.0 * (f(h) - f(-h)) - (f(2 * h) - f(-2 * h))) / (12 * h);
  }
  static Point shifted(Point x, int d, double h) {
    x[d] += h;
    return x;
  }
  Vector force(const Point& x, double t) const {
    const double h = 2e-3;
    Vector f = difference([&](double s) { return density * eps(x, t + s) * velocity(x, t + s); }, h);
    for (int d = 0; d < dim; ++d) {
      f += difference(
          [&](double s) {
            const Point a = shifted(x, d, s);
            const Vector u = velocity(a, t);
            std::array<Vector, dim> slope;
            for (int e = 0; e < dim; ++e)
              slope[e] = difference([&](double r) { return velocity(shifted(a, e, r), t); }, h);
            Vector stress = slope[d];
            if (viscous_stress == "full")
              for (int e = 0; e < dim; ++e) {
                stress[e] += slope[e][d];
                stress[d] -= 2.0 / 3.0 * slope[e][e];
              }
            return Vector(eps(a, t) * (density * u[d] * u - viscosity * stress));
          },
          h);
      f[d] += (model_a ? eps(x, t) : 1.0) *
              difference([&](double s) { return pressure(shifted(x, d, s), t); }, h);
    }
    return f + drag * velocity(x, t);
  }

  FluidParameters parameters() const {
    FluidParameters p;
    p.density = density;
    p.viscosity = viscosity;
    p.formulation = model_a ? "A" : "B";
    p.subscales = subscales;
    p.viscous_stress = viscous_stress;
    p.pressure_tolerance = 1e-11;
    return p;
  }
  BoundaryConditions<dim> conditions(const Domain<dim>& domain) const {
    BoundaryConditions<dim> c;
    for (const auto& [id, name] : domain.sides()) {
      c[name].type = BoundaryType::velocity_inlet;
      const int normal = id / 2;
      c[name].velocity = [*this, normal](const Point& x, double t) {
        Vector u = velocity(x, t);
        u[normal] = 0;  // exactly; the formula leaves round-off
        return u;
      };
    }
    return c;
  }
  std::vector<double> eps_at(const QuadratureLayout<dim>& layout, double t) const {
    std::vector<double> e;
    for (const Point& x : layout.position) e.push_back(eps(x, t));
    return e;
  }
  Exchange<dim> exchange(const QuadratureLayout<dim>& layout, double t) const {
    Exchange<dim> e;
    e.void_fraction = eps_at(layout, t);
    e.drag_coefficient.assign(layout.size(), drag);
    for (const Point& x : layout.position) e.force.push_back(force(x, t));
    return e;
  }
  template <int degree>
  void start(Fluid<dim, degree>& fluid, double t) const {
    fluid.set_initial(
        t, [&](const Point& x) { return velocity(x, t); }, [&](const Point& x) { return pressure(x, t); },
        eps_at(fluid.layout(), t));
  }
  template <int degree>
  typename Fluid<dim, degree>::Errors errors(const Fluid<dim, degree>& fluid) const {
    return fluid.errors([&](const Point& x) { return velocity(x, fluid.time()); },
                        [&](const Point& x) { return pressure(x, fluid.time()); });
  }
};

/// A unit box of `cells` per edge; with `hanging`, the cells around the centre are refined once.
template <int dim>
std::unique_ptr<Domain<dim>> unit_box(int cells, bool hanging = false,
                                      const std::vector<std::string>& periodic = {}) {
  DomainParameters p;
  p.cells.assign(dim, cells);
  p.periodic = periodic;
  auto domain = std::make_unique<Domain<dim>>(p, MPI_COMM_WORLD);
  if (hanging) {
    dealii::Point<dim> centre;
    for (int d = 0; d < dim; ++d) centre[d] = 0.5;
    for (const auto& cell : domain->triangulation().active_cell_iterators())
      if (cell->is_locally_owned() && cell->center().distance(centre) < 0.3) cell->set_refine_flag();
    domain->triangulation().execute_coarsening_and_refinement();
  }
  return domain;
}

}  // namespace seedflow
