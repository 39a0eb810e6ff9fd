#include "seedflow/coupling/coupled_step.h"

#include <gtest/gtest.h>

#include <iostream>

#include "seedflow/seeds/template_parameters.h"

namespace seedflow {
namespace {

/// Three rigid seeds in a closed box of 30 x 30 x 45 mm, cells of 3 mm.
struct Box {
  CouplingParameters coupling;
  FluidParameters fluid_parameters;
  EffectSet effects;
  DemParameters dem_parameters;
  double width = 4e-3;

  Box() {
    fluid_parameters.density = 1000;
    fluid_parameters.viscosity = 0.01;
    dem_parameters.time_step = 5e-5;
  }

  struct Outcome {
    std::vector<SeedState> seeds;
    double total, exchange, seeds_alone, volume, mass;
    double air_speed;  ///< largest [m/s]
  };

  Outcome run(int steps, double dt = 1e-3) {
    Dem dem(dem_parameters);
    const int material = dem.add_material({});
    SeedTemplateParameters model;
    model.n_spheres = 36;
    const int shape = dem.add_template(make_seed_template(model), material, true);
    dem.add_box({0, 0, 0}, {0.03, 0.03, 0.045}, material);
    dem.add_seed(shape, {0.011, 0.012, 0.030});
    dem.add_seed(shape, {0.018, 0.017, 0.026}, {}, {0.02, 0, 0});
    dem.add_seed(shape, {0.014, 0.016, 0.012}, {}, {}, {0, 50, 0});

    DomainParameters box;
    box.upper = {0.03, 0.03, 0.045};
    box.cells = {10, 10, 15};
    Domain<3> domain(box, MPI_COMM_WORLD);
    Fluid<3> fluid(fluid_parameters, domain);
    PointLocation<3> location;
    location.build(domain.triangulation(), {0, 0, 0}, {0.03, 0.03, 0.045}, {{10, 10, 15}});
    const AirProperties air{fluid_parameters.density, fluid_parameters.viscosity,
                            fluid_parameters.formulation == "A"};
    CoupledStep step(coupling, width, fluid, location, dem, effects, air, dem_parameters.gravity,
                     MPI_COMM_WORLD);
    fluid.set_initial(
        0, [](const dealii::Point<3>&) { return dealii::Tensor<1, 3>(); },
        [](const dealii::Point<3>&) { return 0.0; }, step.void_fraction());
    Outcome outcome{};
    for (int i = 0; i < steps; ++i) {
      step.advance(dt);
      outcome.mass = std::max(outcome.mass, fluid.mass_balance().largest);
    }
    for (int s = 0; s < dem.n_seeds(); ++s) outcome.seeds.push_back(dem.seed_state(s));
    for (const auto& u : fluid.velocity()) outcome.air_speed = std::max(outcome.air_speed, u.norm());
    outcome.air_speed = dealii::Utilities::MPI::max(outcome.air_speed, MPI_COMM_WORLD);
    outcome.total = step.momentum().total_error();
    outcome.exchange = step.momentum().exchange_error();
    outcome.seeds_alone = step.momentum().seeds_error();
    outcome.volume = step.largest_volume_error();
    return outcome;
  }

  void make_literal() {
    coupling.drag_on = "sub-sphere";
    coupling.exchange_kernel = "cell";
    coupling.void_fraction_kernel = "sampled";
    coupling.solid_volume = "sub-spheres";
    coupling.undisturbed_velocity = "none";
  }
};

void expect_balances(const Box::Outcome& o, const std::string& what) {
  EXPECT_LT(o.exchange, 1e-12) << what;     // the same weights there and back: round-off
  EXPECT_LT(o.seeds_alone, 1e-12) << what;  // bookkeeping of impulses
  EXPECT_LT(o.total, 1e-8) << what;         // the air's solver tolerance
  EXPECT_LT(o.volume, 1e-12) << what;
  EXPECT_LT(o.mass, 1e-8) << what;
}

TEST(CoupledStepMpi, BalancesCloseForSeedDrag) {
  expect_balances(Box().run(15), "seed drag");
}

TEST(CoupledStepMpi, BalancesCloseForTheLiteralModel) {
  Box box;
  box.make_literal();
  expect_balances(box.run(15), "literal");
}

TEST(CoupledStepMpi, BalancesCloseInModelB) {
  Box box;
  box.fluid_parameters.formulation = "B";
  expect_balances(box.run(10), "model B");
}

TEST(CoupledStepMpi, BalancesCloseForAnyDragStrength) {
  // From nearly none (a gas) to a seed stuck in honey, where k dt / m is about 2000.
  for (const double viscosity : {2e-5, 0.1, 50.0}) {
    Box box;
    box.make_literal();
    box.fluid_parameters.viscosity = viscosity;
    const Box::Outcome o = box.run(8);
    expect_balances(o, "viscosity " + std::to_string(viscosity));
    for (const SeedState& s : o.seeds) EXPECT_LT(norm(s.velocity), 0.12) << "no drag may speed a seed up";
  }
}

TEST(CoupledStepMpi, BalancesCloseWithAllForcesOfTheCatalogue) {
  Box box;
  for (const char* name : {"Added mass", "History force", "Saffman lift", "Magnus lift", "Rotational drag"})
    box.effects[name].set_strength(1);
  expect_balances(box.run(10), "all forces");
}

TEST(CoupledStepMpi, TheSameRunTwiceIsTheSame) {
  Box box;
  const Box::Outcome a = box.run(5), b = box.run(5);
  for (std::size_t s = 0; s < a.seeds.size(); ++s)
    EXPECT_EQ(norm(a.seeds[s].velocity - b.seeds[s].velocity), 0);
}

TEST(CoupledStep, OneWayCouplingLeavesTheAirAtRest) {
  Box box;
  box.coupling.undisturbed_velocity = "none";
  // Three net weights of 1.1e-4 N over 20 ms on 0.04 kg of fluid: 1.6e-4 m/s in the mean, more at the seeds.
  EXPECT_GT(box.run(20).air_speed, 1e-4);
  box.coupling.two_way = false;
  const Box::Outcome one = box.run(20);
  EXPECT_EQ(one.air_speed, 0);
  EXPECT_LT(one.seeds_alone, 1e-12);
  // After 20 ms the seed is as fast as one in fluid at rest: m dv/dt = (m - rho V) g - k(v) v.
  const double volume = M_PI / 6 * std::pow(4e-3, 3), mass = 1340 * volume;
  double speed = 0;
  for (int i = 0; i < 20000; ++i) {
    const double reynolds = 1000 * 4e-3 * speed / 0.01;
    const double drag = 3 * M_PI * 0.01 * 4e-3 * (1 + 0.15 * std::pow(reynolds, 0.687));
    speed += 1e-6 * ((mass - 1000 * volume) * 9.81 - drag * speed) / mass;
  }
  EXPECT_NEAR(-one.seeds[0].velocity.z, speed,
              0.01 * speed);  // drag coefficient of the start of each 1 ms step
}

/// The seed's own disturbance takes time to build up: in the first 50 ms the record of its forces must give
/// the speed of a seed in fluid without it, which the steady disturbance undershoots.
TEST(CoupledStep, TransientSelfDisturbanceAtTheStart) {
  const auto speed = [](const std::string& correction) {
    DemParameters dem_parameters;
    dem_parameters.time_step = 5e-5;
    Dem dem(dem_parameters);
    const int material = dem.add_material({});
    SeedTemplateParameters model;
    model.n_spheres = 36;
    dem.add_seed(dem.add_template(make_seed_template(model), material, true), {0.03, 0.03, 0.04});
    DomainParameters box;
    box.upper = {0.06, 0.06, 0.06};
    box.cells = {15, 15, 15};
    Domain<3> domain(box, MPI_COMM_WORLD);
    FluidParameters fluid_parameters;
    fluid_parameters.density = 1000;
    fluid_parameters.viscosity = 0.01;
    Fluid<3> fluid(fluid_parameters, domain);
    PointLocation<3> location;
    location.build(domain.triangulation(), {0, 0, 0}, {0.06, 0.06, 0.06}, {{15, 15, 15}});
    EffectSet effects;
    CouplingParameters coupling;
    coupling.undisturbed_velocity = correction;
    CoupledStep step(coupling, 4e-3, fluid, location, dem, effects, {1000, 0.01, true},
                     dem_parameters.gravity, MPI_COMM_WORLD);
    fluid.set_initial(
        0, [](const dealii::Point<3>&) { return dealii::Tensor<1, 3>(); },
        [](const dealii::Point<3>&) { return 0.0; }, step.void_fraction());
    for (int i = 0; i < 50; ++i) step.advance(1e-3);
    return -dem.seed_state(0).velocity.z;
  };
  const double alone = 0.07910;  // m dv/dt = (m - rho V) g - k(v) v, Schiller-Naumann, at 50 ms
  const double transient = speed("transient"), steady = speed("oseen");
  std::cout << "speed at 50 ms: alone " << alone << ", transient " << transient << ", steady " << steady
            << " m/s\n";
  EXPECT_NEAR(transient, alone, 0.01 * alone);  // walls 7.5 diameters away
  EXPECT_LT(std::abs(transient - alone), std::abs(steady - alone));
}

}  // namespace
}  // namespace seedflow
