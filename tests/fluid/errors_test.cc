#include <gtest/gtest.h>

#include "manufactured.h"

// Every mistake says what, where and what to do.

namespace seedflow {
namespace {

template <typename Error, typename F>
void expect_message(const F& f, const std::vector<std::string>& parts) {
  try {
    f();
    FAIL() << "no error";
  } catch (const Error& e) {
    for (const auto& part : parts) EXPECT_NE(std::string(e.what()).find(part), std::string::npos) << e.what();
  }
}

void expect_bad_conditions(const std::string& text, const std::vector<std::string>& parts) {
  const auto domain = unit_box<2>(2);
  FluidParameters p;
  p.boundary_conditions = text;
  expect_message<InputError>([&] { Fluid<2>(p, *domain); }, parts);
}

TEST(FluidErrors, BoundaryConditions) {
  expect_bad_conditions("left: wall", {"has no condition", "*: wall"});
  expect_bad_conditions("lefd: wall; *: wall", {"lefd", "left"});
  expect_bad_conditions("left: velocity inled, 1, 0; *: wall", {"velocity inled", "velocity inlet"});
  expect_bad_conditions("left: velocity inlet, 1; *: wall", {"left", "needs 2 values", "1 given"});
  expect_bad_conditions("left: velocity inlet, 1, q+; *: wall", {"left", "q+", "expressions in x, y, t"});
  expect_bad_conditions("left: wall; left: slip; *: wall", {"left", "twice"});
  expect_bad_conditions("left: periodic; *: wall", {"left", "Periodic sides"});
  expect_bad_conditions("left wall", {"left wall", "side: type"});
}

TEST(FluidErrors, ClosedDomainThatLosesVoidVolume) {
  const auto domain = unit_box<2>(4);
  Fluid<2> fluid({}, *domain);
  Exchange<2> e;
  e.clear(fluid.layout().size());
  for (double& v : e.void_fraction) v = 0.9;
  expect_message<RunError>([&] { fluid.advance(0.1, e); }, {"closed", "t = 0 s", "pressure outlet"});
}

TEST(FluidErrors, BadExchange) {
  const auto domain = unit_box<2>(4);
  Fluid<2> fluid({}, *domain);
  Exchange<2> good;
  good.clear(fluid.layout().size());
  Exchange<2> e = good;
  e.void_fraction[3] = 0;
  expect_message<RunError>([&] { fluid.advance(0.1, e); }, {"void fraction", "(0, 1]", "kernel"});
  e = good;
  e.drag_coefficient[5] = -1;
  expect_message<RunError>([&] { fluid.advance(0.1, e); }, {"drag coefficient is negative"});
  e = good;
  e.force[5][1] = NAN;
  expect_message<RunError>([&] { fluid.advance(0.1, e); }, {"force", "not finite"});
  e = good;
  e.force.resize(2);
  expect_message<RunError>([&] { fluid.advance(0.1, e); }, {"2 quadrature points of"});
  expect_message<RunError>([&] { fluid.advance(-1, good); }, {"time step"});
}

TEST(FluidErrors, SolverThatDoesNotConverge) {
  const Manufactured<2> m;
  const auto domain = unit_box<2>(16);
  FluidParameters p = m.parameters();
  p.max_iterations = 1;
  Fluid<2> fluid(p, *domain, m.conditions(*domain));
  m.start(fluid, 0);
  expect_message<RunError>([&] { fluid.advance(0.1, m.exchange(fluid.layout(), 0.1)); },
                           {"not solved in 1 iterations", "dt = 0.1 s", "Reduce the time step"});
}

TEST(FluidErrors, ParametersAreDeclared) {
  Parameters parameters;
  FluidParameters fluid;
  DomainParameters domain;
  fluid.declare(parameters);
  domain.declare(parameters);
  EXPECT_EQ(parameters.unit("Air/Density"), "kg/m3");
  EXPECT_EQ(parameters.value("Air/Linear solver/Backend"), "trilinos");
  EXPECT_EQ(parameters.value("Air domain/Refinements"), "0");
}

}  // namespace
}  // namespace seedflow
