#include "seedflow/coupling/one_way_step.h"

#include <gtest/gtest.h>

#include <cmath>

#include "seedflow/effects/drag_laws.h"
#include "seedflow/seeds/template_parameters.h"

namespace seedflow {
namespace {

/// One seed of the paper's model N = 70 in a uniform upward flow, under its weight.
struct SeedInUniformFlow {
  CouplingParameters coupling;
  PrescribedAirParameters flow_parameters;
  EffectSet effects;
  DemParameters dem_parameters;
  AirProperties air{1000, 0.01, true};
  double upward = 0.05;  ///< [m/s]

  /// Terminal slip speed [m/s].
  double terminal_slip(const std::string& reading, double end_time) {
    SeedTemplateParameters model;
    model.reading = reading;
    dem_parameters.time_step = 5e-5;  // rigid, nothing to touch
    Dem dem(dem_parameters);
    const int material = dem.add_material({});
    dem.add_seed(dem.add_template(make_seed_template(model), material, true), {0, 0, 0});
    flow_parameters.velocity = {"0", "0", std::to_string(upward)};
    PrescribedAir flow(flow_parameters, air.density, air.viscosity);
    OneWayStep step(coupling, flow, dem, effects, air, dem_parameters.gravity);
    for (int i = 0; i < std::lround(end_time / 1e-3); ++i) step.advance(1e-3);
    return upward - dem.seed_state(0).velocity.z;
  }
};

TEST(OneWayStep, DragOnEverySubSphereReachesTheAnalyticRoot) {
  // Each of N sub-spheres carries an N-th of the net weight, dragged as if alone (paper Eqs. 6-7).
  for (const char* reading : {"radius", "diameter"})
    for (const char* buoyancy : {"seed", "none"}) {
      SeedInUniformFlow run;
      run.coupling.drag_on = "sub-sphere";
      run.coupling.buoyancy_volume = buoyancy;
      run.effects["Drag"].set_choice("Law", "As printed");
      const double volume = M_PI / 6 * std::pow(4e-3, 3);
      const double buoyant = std::string(buoyancy) == "seed" ? volume : 0.0;
      const double net = 9.81 * (1340 * volume - 1000 * buoyant);
      const double diameter = std::string(reading) == "radius" ? 0.8e-3 : 0.4e-3;
      const double root = terminal_speed(drag_law("As printed"), net / 70, diameter, 1000, 0.01);
      EXPECT_NEAR(run.terminal_slip(reading, 1.0), root, 1e-3 * root) << reading << ", buoyancy " << buoyancy;
    }
}

TEST(OneWayStep, DragOnTheSeedIsThatOfASphere) {
  SeedInUniformFlow run;
  EXPECT_NEAR(run.terminal_slip("radius", 1.0), 0.1018, 1e-4);  // the known root, Re = 40.7
}

TEST(OneWayStep, AddedMassSlowsTheStartAndNotTheEnd) {
  // At rest in fluid at rest: (m + m_a) dv/dt = m g - rho V g.
  SeedInUniformFlow run;
  run.upward = 0;
  const double volume = M_PI / 6 * std::pow(4e-3, 3), mass = 1340 * volume, fluid = 1000 * volume;
  const double free = 9.81 * (mass - fluid) / mass, slowed = 9.81 * (mass - fluid) / (mass + 0.5 * fluid);
  // After 1 ms the drag is below 1 % of the weight.
  EXPECT_NEAR(run.terminal_slip("radius", 1e-3) / 1e-3, free, 0.02 * free);
  run.effects["Added mass"].set_strength(1);
  EXPECT_NEAR(run.terminal_slip("radius", 1e-3) / 1e-3, slowed, 0.02 * slowed);
}

TEST(PrescribedAir, DerivativesOfAVortex) {
  // u = (-w y, w x, a t): vorticity 2 w, Du/Dt = (-w^2 x, -w^2 y, a), grad p = -rho Du/Dt.
  PrescribedAirParameters p;
  p.velocity = {"-3*y", "3*x", "0.5*t"};
  const PrescribedAir air(p, 1000, 0.01);
  const FlowAtPoint f = air.at({0.02, 0.01, 0.3}, 0.7);
  EXPECT_NEAR(f.vorticity.z, 6, 1e-9);
  EXPECT_NEAR(f.acceleration.x, -9 * 0.02, 1e-9);
  EXPECT_NEAR(f.acceleration.y, -9 * 0.01, 1e-9);
  EXPECT_NEAR(f.acceleration.z, 0.5, 1e-9);
  EXPECT_NEAR(f.pressure_gradient.x, 9000 * 0.02, 1e-4);  // the second difference keeps ten digits
}

TEST(PrescribedAir, MalformedExpressionIsRefused) {
  PrescribedAirParameters p;
  p.velocity[1] = "3*";
  try {
    PrescribedAir air(p, 1.2, 1.8e-5);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("Velocity y"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace seedflow
