#include <gtest/gtest.h>

#include <cmath>

#include "seedflow/effects/single_body.h"

namespace seedflow {
namespace {

/// A tracer: follows whatever velocity the drag tells it within a thousandth of an eddy's life.
FlowAtBody tracer(std::int64_t body) {
  FlowAtBody f;
  f.body = body, f.time_step = 1e-2, f.diameter = 1e-4;
  return f;
}

TEST(TurbulentDispersion, SpreadOfTracersIsThatOfARandomWalk) {
  // Independent velocities, each constant for T: the variance of the position after time t is u'^2 T t per
  // direction (eddy diffusivity u'^2 T/2). 3000 bodies x 3 directions: standard error 1.5 % of the variance.
  const double rms = 0.2, lifetime = 0.05, end = 1;
  EffectSet set;
  Effect& effect = set["Turbulent dispersion"];
  effect.set_strength(1);
  effect.set_number("Velocity fluctuation", rms);
  effect.set_number("Eddy lifetime", lifetime);
  effect.set_number("Eddy size", 1e9);
  const int bodies = 3000;
  double square = 0;
  Vec3 mean;
  for (int b = 0; b < bodies; ++b) {
    FlowAtBody f = tracer(b);
    Vec3 x;
    for (int i = 0; i < 100; ++i) {
      f.time = i * f.time_step;
      BodyForce force;
      force.drag_coefficient = 2;
      effect.add(f, force);
      EXPECT_EQ(force.drag_coefficient, 2);
      x += (f.time_step / force.drag_coefficient) * force.force;  // the velocity at which the drag vanishes
    }
    square += norm_square(x) / 3, mean += x / bodies;
  }
  const double exact = rms * rms * lifetime * end;
  EXPECT_NEAR(square / bodies, exact, 4.5 * exact * std::sqrt(2.0 / (3 * bodies)));
  for (int d = 0; d < 3; ++d) EXPECT_NEAR(mean[d], 0, 4.5 * std::sqrt(exact / bodies));
}

TEST(TurbulentDispersion, FallingThroughEddiesSpreadsLess) {
  // A body that crosses an eddy in a fifth of its life changes eddies five times as often.
  EffectSet set;
  Effect& effect = set["Turbulent dispersion"];
  effect.set_strength(1);
  effect.set_number("Eddy lifetime", 0.1);
  effect.set_number("Eddy size", 0.02);
  FlowAtBody f = tracer(0);
  f.velocity = {0, 0, -1};
  Vec3 last;
  int changes = 0;
  for (int i = 0; i <= 200; ++i) {
    f.time = i * f.time_step;
    BodyForce force;
    force.drag_coefficient = 1;
    effect.add(f, force);
    if (i > 0 && norm(force.force - last) > 0) ++changes;
    last = force.force;
    BodyForce trial;
    trial.drag_coefficient = 1;
    effect.add(f, trial);  // the same time again leaves the memory alone
    EXPECT_EQ(norm(trial.force - force.force), 0);
  }
  EXPECT_NEAR(changes, 100, 1);  // 2 s in steps of 10 ms, 20 mm at 1 m/s
}

TEST(TurbulentDispersion, TheSeedNumberPicksTheRealisation) {
  const auto end = [](double number) {
    PrescribedFlow flow;
    EffectSet set;
    set["Turbulent dispersion"].set_strength(1);
    set["Turbulent dispersion"].set_number("Seed number", number);
    SingleBody sphere({1e-3, 1100, 1}, flow, set);
    return sphere.run({0.5}, 1e-3).back().position;
  };
  EXPECT_EQ(norm(end(1) - end(1)), 0);
  EXPECT_GT(norm(end(1) - end(2)), 1e-4);
}

}  // namespace
}  // namespace seedflow
