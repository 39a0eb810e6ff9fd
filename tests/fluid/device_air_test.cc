// What a device's air needs of the flow solver: eddy viscosity, flow through each side, samples along a line.

#include <gtest/gtest.h>

#include <cmath>

#include "seedflow/fluid/fluid.h"

namespace seedflow {
namespace {

FluidParameters water_like(const std::string& conditions) {
  FluidParameters p;
  p.density = 1;
  p.viscosity = 0.1;
  p.boundary_conditions = conditions;
  return p;
}

TEST(SidesMpi, flowThroughEachSideAndSamplesOfPoiseuilleFlow) {
  DomainParameters box;
  box.cells = {12, 16};
  box.upper = {2, 1, 0};
  Domain<2> domain(box, MPI_COMM_WORLD);
  Fluid<2> fluid(water_like("left: velocity inlet, 4*y*(1-y), 0; right: pressure outlet, 3; *: wall"),
                 domain);
  for (int s = 0; s < 60; ++s) fluid.advance(0.2, {});
  // The inflow is that of the nodal interpolant of 4 y (1 - y): its trapezoidal rule, 2/3 (1 - h^2).
  const double inflow = 2.0 / 3 * (1 - 1.0 / 256);
  const auto& out = fluid.mass_balance().outflow;
  EXPECT_NEAR(out.at("left"), -inflow, 1e-12);
  EXPECT_NEAR(out.at("right"), inflow, 1e-8) << "what enters leaves, to the pressure solver's tolerance";
  EXPECT_EQ(out.size(), 2u) << "walls let nothing through";
  EXPECT_NEAR(fluid.mass_balance().power.at("right"), 3 * inflow, 1e-7);

  const auto samples = fluid.sample({{0.5, 0.5}, {1.0, 0.25}, {1.5, 0.75}, {5, 0.5}});
  const double speed[] = {1, 0.75, 0.75};
  for (int i = 0; i < 3; ++i) {
    ASSERT_TRUE(samples[i].inside);
    // As in Flow.Poiseuille: interpolation error of the parabola, 1 % of the pressure difference.
    EXPECT_NEAR(samples[i].velocity[0], speed[i], 0.01);
    EXPECT_NEAR(samples[i].velocity[1], 0, 0.005);
    EXPECT_NEAR(samples[i].pressure, 3 + 0.8 * (2 - 0.5 * (i + 1)), 0.02);
  }
  EXPECT_FALSE(samples[3].inside);
}

/// Air at rest has no flow yet that a tolerance could refer to: it is the flow that the pressure drives.
TEST(SidesMpi, airAtRestStartsByAPressureDifference) {
  DomainParameters box;
  box.cells = {10, 8, 6};
  Domain<3> domain(box, MPI_COMM_WORLD);
  FluidParameters p = water_like("left: pressure inlet, 0; right: pressure outlet, -100*t; *: wall");
  p.max_iterations = 100;
  Fluid<3> fluid(p, domain);
  for (int s = 0; s < 3; ++s) {
    fluid.advance(1e-3, {});
    EXPECT_LT(fluid.mass_balance().largest, 1e-8);
    EXPECT_GT(fluid.mass_balance().outflow.at("right"), 0);
  }
}

TEST(EddyViscosityMpi, leavesShearFlowAsItIs) {
  DomainParameters box;
  box.cells = {4, 4, 4};
  box.periodic = {"left-right", "front-back"};
  Domain<3> domain(box, MPI_COMM_WORLD);
  FluidParameters p = water_like("bottom: wall; top: moving wall, 1, 0.5, 0");
  p.viscosity = 1;
  p.eddy_viscosity = 1;
  Fluid<3> fluid(p, domain);
  for (int s = 0; s < 150; ++s) fluid.advance(0.2, {});
  const auto e = fluid.errors(
      [](const auto& x) {
        return dealii::Tensor<1, 3>({x[2], 0.5 * x[2], 0});
      },
      [](const auto&) { return 0.0; });
  EXPECT_LT(e.nodal_velocity, 1e-9);
}

/// Taylor-Green vortices, u = sin x cos y, v = -cos x sin y: the eddies' viscosity takes
/// int rho nu_t |grad u|^2 per time from the energy, on top of what is lost without it.
TEST(EddyViscosityMpi, takesTheEnergyThatItsFormulaSays) {
  const int cells = 32;
  const double size = 2 * M_PI, h = size / cells, dt = 1e-3, c_w = 0.5;
  const auto velocity = [](const dealii::Point<2>& x) {
    return dealii::Tensor<1, 2>({std::sin(x[0]) * std::cos(x[1]), -std::cos(x[0]) * std::sin(x[1])});
  };
  const auto energy_after_a_step = [&](double strength) {
    DomainParameters box;
    box.cells = {double(cells), double(cells)};
    box.upper = {size, size, 0};
    box.periodic = {"left-right", "bottom-top"};
    Domain<2> domain(box, MPI_COMM_WORLD);
    FluidParameters p = water_like("");
    p.viscosity = 1e-6;
    p.eddy_viscosity = strength;
    p.eddy_constant = c_w;
    Fluid<2> fluid(p, domain);
    fluid.set_initial(0, velocity,
                      [](const auto& x) { return 0.25 * (std::cos(2 * x[0]) + std::cos(2 * x[1])); });
    fluid.advance(dt, {});
    const auto u = fluid.velocity();
    double sum = 0;
    for (std::size_t q = 0; q < u.size(); ++q) sum += 0.5 * u[q].norm_square() * fluid.layout().JxW[q];
    return dealii::Utilities::MPI::sum(sum, MPI_COMM_WORLD);
  };
  // g = [[a, b], [-b, -a]], a = cos x cos y, b = -sin x sin y: g g = (a^2 - b^2) I in the plane, so
  // Sd:Sd = 2/3 (a^2 - b^2)^2; S:S = 2 a^2.
  double loss = 0;
  const int n = 400;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const double x = size * (i + 0.5) / n, y = size * (j + 0.5) / n;
      const double a = std::cos(x) * std::cos(y), b = -std::sin(x) * std::sin(y);
      const double sd = 2.0 / 3 * std::pow(a * a - b * b, 2), s = 2 * a * a;
      const double nu =
          c_w * c_w * h * h * std::pow(sd, 1.5) / (std::pow(s, 2.5) + std::pow(sd, 1.25) + 1e-30);
      loss += nu * 2 * (a * a + b * b) * std::pow(size / n, 2);
    }
  const double difference = energy_after_a_step(0) - energy_after_a_step(1);
  // Gradients at the points of linear elements are off by (kh)^2/12 = 0.3 %, nu_t by a little more where it
  // peaks.
  EXPECT_NEAR(difference / dt, loss, 0.03 * loss);
}

}  // namespace
}  // namespace seedflow
