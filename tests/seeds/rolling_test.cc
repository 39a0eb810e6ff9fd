// A sphere that rolls on a plane, through the whole DEM.

#include <gtest/gtest.h>

#include <cmath>

#include "contact_ode.h"
#include "sample_templates.h"
#include "seedflow/seeds/dem.h"

namespace seedflow {
namespace {

constexpr double g = 9.81, radius = 2e-3;

struct Table {
  Dem dem;
  ContactLaw law;
  double sink = 0;  ///< overlap at rest [m]
};

/// One sphere at rest on a plane in its static overlap, then set rolling at `speed`.
Table rolling_at(double speed, const ContactProperties& properties, double step = 1e-6) {
  DemParameters p;
  p.time_step = step;
  const Material seed{"seed", 1340, 0.4, 1.5e8}, plate{"resin", 1800, 0.35, 1.3e9};
  Table t{Dem(p), ContactLaw(seed, plate, properties)};
  const SeedTemplate sphere = test::single_sphere();
  const int a = t.dem.add_material(seed), b = t.dem.add_material(plate);
  t.dem.set_contact(a, b, properties);
  t.dem.add_template(sphere, a, true);
  t.dem.add_wall({"plane", {}, {0, 0, 1}, {}, b});
  t.sink = std::pow(sphere.mass * g / (4.0 / 3 * t.law.young * std::sqrt(radius)), 2.0 / 3);
  t.dem.add_seed(0, {0, 0, radius - t.sink}, {}, {speed, 0, 0}, {0, speed / (radius - t.sink), 0});
  return t;
}

// Rolling without slip: m a = -F, 2/5 m R^2 a/R = F R - mu_r m g R, so a = -5/7 mu_r g; it stops after
// v/(5/7 mu_r g) and half that way, and stays.
TEST(Rolling, ConstantTorqueSlowsByFiveSeventhsAndStops) {
  const double mu_r = 0.03, v0 = 0.05, slowing = 5.0 / 7 * mu_r * g;
  ContactProperties p;
  p.static_friction = 0.41;
  p.rolling_friction = mu_r;
  Table t = rolling_at(v0, p);
  t.dem.advance(0.02);  // the tangential spring's start-up has died out
  const double first = t.dem.seed_state(0).velocity.x;
  t.dem.advance(0.15);
  const double measured = (first - t.dem.seed_state(0).velocity.x) / 0.15;
  std::printf("deceleration %.6f m/s2, closed form %.6f\n", measured, slowing);
  EXPECT_NEAR(measured, slowing, 1e-3 * slowing);
  t.dem.advance(0.1);
  const double stop = t.dem.seed_state(0).centre.x;
  EXPECT_NEAR(stop, v0 * v0 / (2 * slowing), 2e-3 * stop);  // less 1e-3 while the spring starts up
  EXPECT_LT(norm(t.dem.seed_state(0).velocity), 1e-9);
  t.dem.advance(0.05);
  EXPECT_NEAR(t.dem.seed_state(0).centre.x, stop, 1e-9);
}

/// Frequency and decay of a swinging velocity sampled every `sample`: from seven changes of sign and the
/// largest values between them.
struct Swing {
  double frequency = 0, decay = 0;
};
template <class Velocity>
Swing swing(double sample, const Velocity& next) {
  std::vector<double> zero, peak;
  double before = 0, when = 0, largest = 0;
  while (zero.size() < 7) {
    const double v = next();
    largest = std::max(largest, std::abs(v));
    if (v * before < 0) {
      zero.push_back(when + sample * before / (before - v));
      peak.push_back(largest);
      largest = 0;
    }
    before = v;
    when += sample;
  }
  const double half_period = (zero[6] - zero[0]) / 6;
  return {M_PI / half_period, -std::log(peak[6] / peak[1]) / (5 * half_period)};
}

// EPSD below its limit is a linear oscillator: tangential spring and rolling spring, each with its dashpot,
// integrated here by Runge-Kutta with x, v, angle, w and the tangential displacement as unknowns. Beside it
// the closed form of pure rolling, (I + m R^2) theta'' = -k_r theta - 2 eta sqrt(I_r k_r) theta', omega =
// omega_0 sqrt(1 - eta^2), decay eta omega_0, k_r = 2.25 k_n mu_r^2 R^2, which leaves out the tangential
// spring: 0.1 % in k_r/(k_t R^2).
TEST(Rolling, EpsdOscillatesDecaysAndRests) {
  const double mu_r = 0.03, eta = 0.1;
  ContactProperties p;
  p.static_friction = 0.41;
  p.rolling_friction = mu_r;
  p.rolling_model = "EPSD";
  p.rolling_damping = eta;
  const Table still = rolling_at(0, p);
  const double mass = test::single_sphere().mass, lever = radius - still.sink;
  const double own = 0.4 * mass * radius * radius, inertia = own + mass * lever * lever;
  const double a = std::sqrt(radius * still.sink), k_n = 4.0 / 3 * still.law.young * a;
  const double k_r = 2.25 * k_n * mu_r * mu_r * lever * lever, natural = std::sqrt(k_r / inertia);
  const double k_t = 8 * still.law.shear * a;
  const double c_r = 2 * eta * std::sqrt(inertia * k_r),
               c_t = test::damping_ratio(0.526) * std::sqrt(10.0 / 3 * mass * k_t);
  // Half the angle at which the spring is fully mobilised.
  const double speed = 0.5 * mu_r * mass * g * lever / k_r * natural * lever, sample = 5e-6;
  std::array<double, 4> y{speed, speed / lever, 0, 0};  // v, w, tangential displacement, angle
  const Swing expected = swing(sample, [&] {
    for (int k = 0; k < 10; ++k)
      test::runge_kutta(y, sample / 10, [&](const std::array<double, 4>& z) {
        const double slip = z[0] - lever * z[1], force = -k_t * z[2] - c_t * slip;
        return std::array<double, 4>{force / mass, (-lever * force - k_r * z[3] - c_r * z[1]) / own, slip,
                                     z[1]};
      });
    return y[0];
  });
  Table t = rolling_at(speed, p, 5e-7);
  const Swing found = swing(sample, [&] {
    t.dem.advance(sample);
    return t.dem.seed_state(0).velocity.x;
  });
  std::printf("frequency %.3f rad/s (%.3f), decay %.3f 1/s (%.3f); pure rolling %.3f, %.3f\n",
              found.frequency, expected.frequency, found.decay, expected.decay,
              natural * std::sqrt(1 - eta * eta), eta * natural);
  EXPECT_NEAR(found.frequency, expected.frequency, 1e-3 * expected.frequency);
  EXPECT_NEAR(found.decay, expected.decay, 1e-3 * expected.decay);
  EXPECT_NEAR(found.frequency, natural * std::sqrt(1 - eta * eta), 2e-3 * natural);
  EXPECT_NEAR(found.decay, eta * natural, 5e-3 * eta * natural);
  t.dem.advance(30 / (eta * natural));
  EXPECT_LT(norm(t.dem.seed_state(0).velocity), 1e-9);
  const double rest = t.dem.seed_state(0).centre.x;
  t.dem.advance(5 / (eta * natural));
  EXPECT_NEAR(t.dem.seed_state(0).centre.x, rest, 1e-12);
}

// EPSD beyond its limit slows like the constant torque, for the dashpot is off at full mobilisation.
TEST(Rolling, EpsdFullyMobilisedIsConstantTorque) {
  const double mu_r = 0.03, slowing = 5.0 / 7 * mu_r * g;
  ContactProperties p;
  p.static_friction = 0.41;
  p.rolling_friction = mu_r;
  p.rolling_model = "EPSD";
  Table t = rolling_at(0.05, p);
  t.dem.advance(0.05);
  const double first = t.dem.seed_state(0).velocity.x;
  t.dem.advance(0.1);
  const double measured = (first - t.dem.seed_state(0).velocity.x) / 0.1;
  std::printf("fully mobilised: %.6f m/s2, closed form %.6f\n", measured, slowing);
  EXPECT_NEAR(measured, slowing, 1e-3 * slowing);
}

TEST(Rolling, WithoutRollingFrictionItRollsOn) {
  ContactProperties p;
  p.rolling_model = "none";
  Table t = rolling_at(0.05, p);
  t.dem.advance(0.2);
  EXPECT_NEAR(t.dem.seed_state(0).velocity.x, 0.05, 1e-6);
}

}  // namespace
}  // namespace seedflow
