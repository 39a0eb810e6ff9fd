#include "seedflow/effects/regularised_disturbance.h"

#include <gtest/gtest.h>

#include <cmath>

#include "seedflow/base/error.h"
#include "seedflow/effects/drag_laws.h"

namespace seedflow {
namespace {

/// The Fourier integral done by brute force in (k, cos theta), for mu = rho = s = 1 and the stream speed
/// `re`; switched on a time t ago (t < 0: for ever).
SelfMobility by_quadrature(double re, double t) {
  SelfMobility sum;
  // k = 8 x^2 and cos theta = y^2 gather points where the stream makes the integrand steep.
  const int nk = 1200, nc = 400;
  for (int j = 0; j < nc; ++j) {
    const double y = (j + 0.5) / nc, c = y * y;
    for (int i = 0; i < nk; ++i) {
      const double x = (i + 0.5) / nk, k = 8 * x * x, diffusion = k * k, stream = re * k * c;
      // Re (1 - exp(-(d + i q) t))/(d + i q)
      const double fade = t < 0 ? 0 : std::exp(-diffusion * t);
      const double real = 1 - fade * std::cos(stream * t), imaginary = fade * std::sin(stream * t);
      const double response =
          (diffusion * real + stream * imaginary) / (diffusion * diffusion + stream * stream);
      const double weight = k * k * std::exp(-0.5 * k * k) * response * (16 * x / nk) * (2 * y / nc) * 2;
      sum.along += weight * (1 - c * c) * 2 * M_PI;
      sum.across += weight * (1 + c * c) * M_PI;
    }
  }
  const double scale = std::pow(2 * M_PI, -3);
  return {sum.along * scale, sum.across * scale};
}

TEST(RegularisedDisturbance, SteadyMobilityIsTheFourierIntegral) {
  // The midpoint sums are good to about 1e-5.
  for (const double re : {0.0, 0.01, 0.5, 0.70, 0.71, 3.0, 10.0, 30.0}) {
    const SelfMobility closed = steady_self_mobility(re), sum = by_quadrature(re, -1);
    EXPECT_NEAR(closed.along, sum.along, 2e-5 * closed.along) << re;
    EXPECT_NEAR(closed.across, sum.across, 2e-5 * closed.across) << re;
  }
}

TEST(RegularisedDisturbance, Limits) {
  const double stokes = std::sqrt(2 / M_PI) / (6 * M_PI);
  EXPECT_NEAR(steady_self_mobility(0).along, stokes, 1e-15);
  EXPECT_NEAR(steady_self_mobility(0).across, stokes, 1e-15);
  // Maxey & Patel: equal Gaussians of width a/sqrt(pi) give the mobility of a sphere of radius a.
  const double a = 1.7, sigma = a / std::sqrt(M_PI), s = effective_width(sigma, sigma);
  EXPECT_NEAR(steady_self_mobility(0).along / s, 1 / (6 * M_PI * a), 1e-15);
  // Oseen's first correction for any compact force: F/(6 pi mu) (1/R - 3/8 U/nu), so -Re/(16 pi) along the
  // stream.
  EXPECT_NEAR((steady_self_mobility(1e-4).along - stokes) / 1e-4, -1 / (16 * M_PI), 1e-6);
  // Wake: F/(rho U 2 pi s^2) is its peak, half of it stands at the body; the next term is -2/X^2 of S.
  for (const double re : {1e3, 1e5, 1e8}) {
    EXPECT_NEAR(steady_self_mobility(re).along * 4 * M_PI * re, 1, 2 / re) << re;
    EXPECT_GT(steady_self_mobility(re).across, 0);
  }
  // Series and closed form meet at X = 0.5.
  const double re = 0.5 * std::sqrt(2.0);
  EXPECT_NEAR(steady_self_mobility(re * (1 - 1e-12)).along, steady_self_mobility(re * (1 + 1e-12)).along,
              1e-13);
  EXPECT_NEAR(steady_self_mobility(re * (1 - 1e-12)).across, steady_self_mobility(re * (1 + 1e-12)).across,
              1e-13);
}

TEST(RegularisedDisturbance, StartUp) {
  for (const double re : {0.0, 1.0, 10.0})
    for (const double t : {0.01, 0.3, 2.0}) {
      const SelfMobility closed = startup_self_mobility(re, t), sum = by_quadrature(re, t);
      EXPECT_NEAR(closed.along, sum.along, 2e-5 * closed.along) << re << ' ' << t;
      EXPECT_NEAR(closed.across, sum.across, 2e-5 * closed.across) << re << ' ' << t;
    }
  // Short times: 2/3 of the force per unit mass of fluid under the Gaussian; the pressure takes the rest.
  EXPECT_NEAR(startup_self_mobility(5, 1e-6).along / 1e-6, 2.0 / 3 * std::pow(2 * M_PI, -1.5), 1e-5);
  // Long times: the steady state, approached like t^-1/2 in Stokes flow, faster in a stream.
  EXPECT_NEAR(startup_self_mobility(0, 1e8).along, steady_self_mobility(0).along, 1e-5);
  EXPECT_NEAR(startup_self_mobility(40, 1e8).along, steady_self_mobility(40).along, 1e-7);
  EXPECT_NEAR(startup_self_mobility(40, 1e8).across, steady_self_mobility(40).across, 1e-7);
}

TEST(RegularisedDisturbance, RecordOfForceAndPath) {
  // A steady force in a steady stream, from the start, in steps.
  const CarrierFluid fluid = {1000, 0.01};
  const double width = 5e-3, speed = 0.1, nu = 1e-5, dt = 5e-3;
  const Vec3 force = {0, 1e-4, 2e-4};
  std::vector<double> memory;
  TransientSelfVelocity transient(memory);
  transient.append(0, {}, {});
  for (int i = 1; i <= 2000; ++i) {
    transient.append(i * dt, force, {0, 0, -speed * i * dt});
    if (i != 3 && i != 20 && i != 200 && i != 2000) continue;
    const SelfMobility m = startup_self_mobility(speed * width / nu, nu * i * dt / (width * width));
    const Vec3 u = transient.velocity(width, fluid);
    const double unit = 1 / (fluid.viscosity * width);
    // 1e-3: three-point rule on intervals of 1/16 of their age
    EXPECT_NEAR(u.z, m.along * force.z * unit, 1e-3 * m.along * force.z * unit) << i;
    EXPECT_NEAR(u.y, m.across * force.y * unit, 1e-3 * m.across * force.y * unit) << i;
    EXPECT_EQ(u.x, 0);
  }
  EXPECT_LT(memory.size() / 7, 2 * 16 * (1 + std::log(2000.0 / 16)));
  EXPECT_THROW(transient.append(1.0, force, {}), RunError);
}

TEST(RegularisedDisturbance, DisplacementOfTheBodyVolume) {
  // Mean over the Gaussian of the potential flow, in real space: u'_z(r on the axis frame) averaged over
  // directions is
  // -(v - u) eps_p(r)/3 at every r, so the mean is -1/3 of the mean eps_p = integral of V G_a G_b.
  const double a = 0.7, b = 1.1, volume = 0.2, s = effective_width(a, b);
  double mean = 0;
  const int n = 20000;
  for (int i = 0; i < n; ++i) {
    const double r = 12 * (i + 0.5) / n;
    const auto gauss = [r](double w) {
      return std::pow(2 * M_PI * w * w, -1.5) * std::exp(-0.5 * r * r / (w * w));
    };
    mean += 4 * M_PI * r * r * volume * gauss(a) * gauss(b) * 12 / n;
  }
  EXPECT_NEAR(self_solid_fraction(volume, s), mean, 1e-10);
  // A body moving up (+z) through fluid at rest sees the fluid going down.
  const Vec3 slip = {0, 0, -2};
  EXPECT_NEAR(displacement_self_velocity(slip, volume, s).z, -2 * mean / 3, 1e-10);
}

TEST(RegularisedDisturbance, UndisturbedSlipIsRecovered) {
  const CarrierFluid fluid = {1000, 0.01};
  const double d = 4e-3, volume = M_PI / 6 * d * d * d;
  const auto exchange = [&](double speed) {
    return 3 * M_PI * fluid.viscosity * d *
           drag_law("Schiller-Naumann").factor(fluid.density * d * speed / fluid.viscosity, 1, 1);
  };
  for (const double width : {0.75 * d, 1.5 * d, 4 * d})
    for (const double speed : {1e-4, 0.01, 0.1018, 1.0}) {
      const Vec3 slip = {0.6 * speed, 0, -0.8 * speed};
      const Vec3 measured = slip + displacement_self_velocity(slip, volume, width) +
                            steady_self_velocity(-exchange(speed) * slip, slip, width, fluid);
      const Vec3 back = undisturbed_slip(measured, exchange, volume, width, fluid);
      EXPECT_NEAR(norm(back - slip), 0, 1e-12 * speed) << width << ' ' << speed;
    }
  EXPECT_THROW(undisturbed_slip({1e-6, 0, 0}, exchange, 0, 0.3 * d, fluid), RunError);
}

}  // namespace
}  // namespace seedflow
