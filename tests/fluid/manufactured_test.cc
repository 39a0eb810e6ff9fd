#include "manufactured.h"

#include <deal.II/grid/grid_generator.h>
#include <gtest/gtest.h>

// Orders of convergence against solutions known in closed form, with a void fraction that varies in space and
// time.

namespace seedflow {
namespace {

struct Result {
  double velocity, pressure, mass, total, momentum;
};

/// Trapezia: rows of vertices inside the unit square are shifted up and down in turn by a fifth of a cell, so
/// that no cell is a parallelogram, however fine the mesh.
std::unique_ptr<Domain<2>> trapezia(int cells) {
  dealii::Triangulation<2> mesh;
  dealii::GridGenerator::subdivided_hyper_cube(mesh, cells, 0, 1, true);
  std::vector<bool> moved(mesh.n_vertices(), false);
  for (const auto& cell : mesh.active_cell_iterators())
    for (const auto v : cell->vertex_indices()) {
      auto& x = cell->vertex(v);
      if (moved[cell->vertex_index(v)] || x[1] < 1e-9 || x[1] > 1 - 1e-9) continue;
      moved[cell->vertex_index(v)] = true;
      x[1] += (std::lround(x[0] * cells) % 2 ? 0.2 : -0.2) / cells;
    }
  return std::make_unique<Domain<2>>(
      mesh,
      std::map<dealii::types::boundary_id, std::string>{{0, "left"}, {1, "right"}, {2, "bottom"}, {3, "top"}},
      std::vector<std::string>(), MPI_COMM_WORLD);
}

template <int dim, int degree>
Result solve(const Manufactured<dim>& m, Domain<dim>& domain, double end, int steps);

template <int dim, int degree>
Result solve(const Manufactured<dim>& m, int cells, bool hanging, double end, int steps) {
  return solve<dim, degree>(m, *unit_box<dim>(cells, hanging), end, steps);
}

template <int dim, int degree>
Result solve(const Manufactured<dim>& m, Domain<dim>& domain, double end, int steps) {
  Fluid<dim, degree> fluid(m.parameters(), domain, m.conditions(domain));
  m.start(fluid, 0.1);
  Result r{};
  const double dt = end / steps;
  for (int s = 0; s < steps; ++s) {
    fluid.advance(dt, m.exchange(fluid.layout(), fluid.time() + dt));
    r.mass = std::max(r.mass, fluid.mass_balance().largest);
    r.total = std::max(r.total, fluid.mass_balance().total);
    r.momentum = std::max(r.momentum, fluid.momentum_balance().residual);
  }
  const auto e = m.errors(fluid);
  r.velocity = e.velocity;
  r.pressure = e.pressure;
  return r;
}

/// dt and h are halved together: order 2 in the velocity shows order 2 in space and in time at once.
void expect_orders(const Result& a, const Result& b, double pressure_order = 1.5) {
  EXPECT_GT(std::log2(a.velocity / b.velocity), 1.9) << a.velocity << " -> " << b.velocity;
  EXPECT_GT(std::log2(a.pressure / b.pressure), pressure_order) << a.pressure << " -> " << b.pressure;
  for (const Result& r : {a, b}) {
    EXPECT_LT(r.mass, 1e-10);  // pressure solved to 1e-11
    EXPECT_LT(r.total, 1e-12);
    EXPECT_LT(r.momentum, 1e-8);  // momentum solved to 1e-11 in every node
  }
}
template <int dim>
void expect_orders(const Manufactured<dim>& m, int cells, bool hanging, double end, int steps,
                   double pressure_order = 1.5) {
  expect_orders(solve<dim, 1>(m, cells, hanging, end, steps),
                solve<dim, 1>(m, 2 * cells, hanging, end, 2 * steps), pressure_order);
}

TEST(Manufactured2d, OrdersOnUniformMeshModelA) {
  expect_orders<2>({}, 16, false, 0.5, 20);
}
TEST(Manufactured2d, OrdersWithHangingNodes) {
  expect_orders<2>({}, 16, true, 0.5, 20);
}
TEST(Manufactured2d, OrdersModelB) {
  Manufactured<2> m;
  m.model_a = false;
  expect_orders(m, 16, false, 0.5, 20);
}
/// div u differs from 0 and eps mu varies, so transpose and trace matter.
TEST(Manufactured2d, OrdersWithFullStress) {
  Manufactured<2> m;
  m.viscous_stress = "full";
  expect_orders(m, 16, true, 0.5, 20);
}
TEST(Manufactured2d, OrdersOnTrapezia) {
  expect_orders(solve<2, 1>({}, *trapezia(16), 0.5, 20), solve<2, 1>({}, *trapezia(32), 0.5, 40));
}
TEST(Manufactured2d, OrdersWithDynamicSubscales) {
  Manufactured<2> m;
  m.subscales = "dynamic";
  expect_orders(m, 16, false, 0.5, 20, 1.0);
  expect_orders(m, 16, true, 0.5, 20, 1.0);
}
TEST(Manufactured3d, OrdersOnUniformMesh) {
  expect_orders<3>({}, 4, false, 0.3, 3);
}
TEST(Manufactured3d, OrdersWithHangingNodes) {
  expect_orders<3>({}, 4, true, 0.3, 3);
}

/// Quadratic elements: better than linear ones by far on as many nodes, order above 2.
TEST(Manufactured2d, QuadraticElements) {
  const Result linear = solve<2, 1>({}, 16, false, 0.2, 40), coarse = solve<2, 2>({}, 4, false, 0.2, 20),
               fine = solve<2, 2>({}, 8, false, 0.2, 40);
  EXPECT_LT(fine.velocity, 0.6 * linear.velocity);
  EXPECT_GT(std::log2(coarse.velocity / fine.velocity), 2.4) << coarse.velocity << " -> " << fine.velocity;
  EXPECT_LT(fine.mass, 1e-10);
}

TEST(Manufactured3d, QuadraticElementsRun) {
  const Result r = solve<3, 2>({}, 2, false, 0.1, 2);
  EXPECT_LT(r.velocity, 0.1);
  EXPECT_LT(r.mass, 1e-10);
  EXPECT_LT(r.momentum, 1e-8);
}

/// Drag over ten orders of magnitude: the velocity stays accurate, mass and momentum are kept.
TEST(Manufactured2d, AnyDrag) {
  for (const double drag : {0.0, 1.0, 1e4, 1e8}) {
    Manufactured<2> m;
    m.drag = drag;
    const Result r = solve<2, 1>(m, 16, true, 0.2, 8);
    EXPECT_LT(r.velocity, 5e-3) << drag;  // max |u| is about 1
    EXPECT_LT(r.mass, 1e-10) << drag;
    EXPECT_LT(r.momentum, 1e-8) << drag;
  }
}

/// A time step far below the diffusive one: the pressure must not develop a checkerboard.
TEST(Manufactured2d, PressureWithTinySteps) {
  Manufactured<2> m;
  const Result coarse = solve<2, 1>(m, 8, false, 0.1, 100), fine = solve<2, 1>(m, 16, false, 0.1, 100);
  EXPECT_GT(std::log2(coarse.pressure / fine.pressure), 1.0) << coarse.pressure << " -> " << fine.pressure;
}

}  // namespace
}  // namespace seedflow
