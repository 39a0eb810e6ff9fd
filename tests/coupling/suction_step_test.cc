// Seeds at the holes of a disc: held, let go, carried around.
#include "seedflow/coupling/suction_step.h"

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "holed_disc.h"
#include "seedflow/seeds/template_parameters.h"

namespace seedflow {
namespace {

/// One seed seated on hole 0 of an upright disc, at 3 o'clock: its weight acts along the disc's face.
struct SeatedSeed {
  DeviceGeometry device;
  SuctionParameters suction;
  CouplingParameters coupling;
  EffectSet effects;
  double speed = 0;
  int n_spheres = 1;
  double shake = 0, frequency = 0;  ///< of the disc along its axis: amplitude [m], [1/s]

  struct Result {
    Vec3 pressure, drag;        ///< mean loads of the last ms [N]
    double away = 0;            ///< distance of the seed from its hole's mouth at the end [m]
    double momentum_error = 0;  ///< relative to the impulse of the pressure
    double cover = 0;
    double height = 0, rate = 0;  ///< of the seed along the disc's axis since the start [m], at the end [m/s]
    double largest_lift = 0;      ///< of the seed from its place on the disc, in the second half [m]
  };

  Result run(double time) {
    DemParameters parameters;
    parameters.gravity = {0, -9.81, 0};
    parameters.time_step = 5e-6;
    Dem dem(parameters);
    int of_seed = 0;
    const int disc = test::add_holed_disc(dem, device, speed, of_seed);
    device.drilled = 1;
    SeedTemplateParameters model;
    model.n_spheres = n_spheres;
    const CoveredHole seat(device.hole_radius(), device.chamfer, 2e-3);
    const double lift = n_spheres == 1 ? 1e-6 : 0.1e-3;
    dem.add_seed(dem.add_template(make_seed_template(model), of_seed, true),
                 {device.pitch_radius, 0,
                  -std::sqrt(4e-6 - seat.seat_radius * seat.seat_radius) + seat.seat_depth - lift},
                 {}, {0, speed * device.pitch_radius, 0});
    if (shake > 0) {
      TimeLaw& law = dem.wall(disc).motion.displacement;
      law.kind = TimeLaw::Kind::sinusoid;
      law.amplitude = shake, law.frequency = frequency;
    }
    SuctionStep air(suction, device, coupling, disc, 2e-3, effects, parameters.gravity);
    const double at_start = dem.seed_state(0).centre.z;
    Result result;
    const Vec3 before = dem.momentum();
    Vec3 from_air;
    double scale = 0;
    const double interval = shake > 0 ? 0.1e-3 : 1e-3;
    const int n = static_cast<int>(std::lround(time / interval));
    for (int i = 0; i < n; ++i) {
      from_air += air.advance(dem, interval);
      scale += interval * norm(air.seed_loads()[0].pressure);
      const double moved = dem.walls()[disc].motion.displacement.at(dem.time()).value;
      result.height = dem.seed_state(0).centre.z - at_start;
      if (2 * i > n) result.largest_lift = std::max(result.largest_lift, moved - result.height);
    }
    result.rate = dem.seed_state(0).velocity.z;
    double weight = 0;
    for (const double m : dem.masses()) weight += m * 9.81;
    const Vec3 error =
        dem.momentum() - before - from_air - dem.wall_impulses()[disc] - Vec3{0, -weight * time, 0};
    const Vec3 mouth = device.hole_centre(0, speed * time);
    result.pressure = air.seed_loads()[0].pressure, result.drag = air.seed_loads()[0].drag;
    result.away = norm(dem.seed_state(0).centre - mouth);
    result.momentum_error = norm(error) / std::max(scale, 1e-12);
    result.cover = air.holes()[0].cover;
    return result;
  }
};

// A seated ball is held by dp x seat area, 21 times its weight and more; the polygon of the rim has 0.9886 of
// the circle, the roughness of the seat leaks 0.2 %.
TEST(SuctionStep, HoldingForceIsPressureTimesSeatArea) {
  for (const double chamfer : {0.0, 0.3e-3}) {
    SeatedSeed seated;
    seated.device.chamfer = chamfer;
    const auto r = seated.run(0.03);
    const double area = M_PI * std::pow(1e-3 + chamfer, 2);
    EXPECT_NEAR(r.pressure.z / (3000 * area), 0.987, 0.005) << chamfer;
    EXPECT_LT(r.away, 2e-3);  // it has not moved
    EXPECT_LT(norm(r.drag), 0.02 * norm(r.pressure));
    EXPECT_LT(r.momentum_error, 1e-9);
  }
}

// A clump of 70 sub-spheres on the same hole: its real surface is uneven, the force that of the seat.
TEST(SuctionStep, ClumpIsHeldToo) {
  SeatedSeed seated;
  seated.n_spheres = 70;
  const auto r = seated.run(0.03);
  EXPECT_NEAR(r.pressure.z / (3000 * M_PI * 1.69e-6), 0.97, 0.04);
  EXPECT_LT(r.away, 2e-3);
}

// The paper's model: drag alone, on sub-spheres as if alone, in air that flows as if no seed were there. It
// is many times smaller than the pressure force, though the air passes the seed at up to 70 m/s.
TEST(SuctionStep, DragAloneIsMuchSmaller) {
  SeatedSeed seated;
  seated.n_spheres = 70;
  seated.suction.blocking = false;
  seated.coupling.drag_on = "sub-sphere";
  const auto r = seated.run(1e-3);
  const double held = 3000 * M_PI * 1.69e-6;
  EXPECT_EQ(norm(r.pressure), 0);
  EXPECT_GT(r.drag.z, 0);
  EXPECT_LT(r.drag.z, 0.5 * held);
  RecordProperty("drag_over_pressure_force", std::to_string(r.drag.z / held));
  std::cout << "drag alone: " << r.drag.z << " N, pressure x seat: " << held << " N" << std::endl;
}

TEST(SuctionStep, WithoutVacuumTheSeedFalls) {
  SeatedSeed seated;
  seated.suction.vacuum = 0;
  const auto r = seated.run(0.05);
  EXPECT_GT(r.away, 5e-3);
  EXPECT_LT(norm(r.pressure), 1e-15);
}

// 0.1 s at 60 rpm: the seed goes 36 degrees with its hole.
TEST(SuctionStep, SeedIsCarriedAround) {
  SeatedSeed seated;
  seated.speed = 2 * M_PI;
  const auto r = seated.run(0.1);
  EXPECT_LT(r.away, 2e-3);
  EXPECT_GT(r.cover, 0.98);
}

// The disc shakes along its axis, z = A sin(2 pi f t). A seed that is held does what the disc does: at 50 Hz
// its contact, whose own frequency is kilohertz, gives way by (50 Hz/kHz)^2.
TEST(SuctionStep, SeedFollowsAShakingDisc) {
  SeatedSeed seated;
  seated.shake = 0.1e-3, seated.frequency = 50;
  const double top_speed = 2 * M_PI * 50 * 0.1e-3;
  const auto middle = seated.run(0.04), top = seated.run(0.045), back = seated.run(0.05);
  EXPECT_NEAR(middle.rate / top_speed, 1, 0.03);
  // The suction presses it some micrometres into the soft disc, at the start of the run.
  EXPECT_NEAR((top.height - middle.height) / 0.1e-3, 1, 0.03);
  EXPECT_NEAR(top.rate / top_speed, 0, 0.03);
  EXPECT_NEAR(back.rate / top_speed, -1, 0.03);
  EXPECT_GT(back.cover, 0.98);
  EXPECT_LT(back.momentum_error, 1e-9);
}

// It comes off where A (2 pi f)^2 exceeds holding force over mass, 350 m/s2.
TEST(SuctionStep, SeedLeavesADiscThatShakesTooHard) {
  SeatedSeed seated;
  const double limit = 0.0157 / (1340 * M_PI / 6 * 64e-9);
  const auto lift = [&](double share) {
    seated.shake = 0.05e-3;
    seated.frequency = std::sqrt(share * limit / seated.shake) / (2 * M_PI);
    return seated.run(0.03).largest_lift;
  };
  EXPECT_LT(lift(0.6), 2e-6);
  EXPECT_GT(lift(1.6), 10e-6);
}

// Where the vacuum ends the force ends.
TEST(SuctionStep, SeedIsLetGoWhereTheVacuumEnds) {
  SeatedSeed seated;
  seated.device.vacuum_from = -2, seated.device.vacuum_to = 0.1;
  seated.speed = 2 * M_PI;
  const auto r = seated.run(0.1);
  EXPECT_EQ(r.cover, 0);
  EXPECT_LT(norm(r.pressure), 1e-15);
  EXPECT_GT(r.away, 10e-3);
}

}  // namespace
}  // namespace seedflow
