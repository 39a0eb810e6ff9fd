// Collisions of single spheres through the whole DEM, against independent integration and closed forms.

#include <gtest/gtest.h>

#include <cmath>

#include "contact_ode.h"
#include "sample_templates.h"
#include "seedflow/seeds/dem.h"
#include "seedflow/seeds/restitution.h"

namespace seedflow {
namespace {

const Material seed{"seed", 1340, 0.4, 1.5e8}, resin{"resin", 1800, 0.35, 1.3e9};
constexpr double radius = 2e-3;

DemParameters weightless(double step) {
  DemParameters p;
  p.gravity = {};
  p.time_step = step;
  return p;
}

struct Collision {
  double restitution = 0, time = 0, depth = 0;
};

/// Two seeds' material spheres meet at `speed`, first touching at the start.
Collision collide(double speed, double step, const ContactProperties& properties, double factor = 1) {
  Dem dem(weightless(step));
  Material m = seed;
  m.shear_modulus *= factor;
  const int material = dem.add_material(m);
  dem.set_contact(material, material, properties);
  dem.add_template(test::single_sphere(), material, true);
  dem.add_seed(0, {0, 0, 0}, {}, {speed / 2, 0, 0});
  dem.add_seed(0, {2 * radius, 0, 0}, {}, {-speed / 2, 0, 0});
  Collision c;
  double before = 0;
  for (int k = 1;; ++k) {
    dem.advance(step);
    const double x = 2 * radius - (dem.seed_state(1).centre.x - dem.seed_state(0).centre.x);
    c.depth = std::max(c.depth, x);
    if (x <= 0) {
      c.time = (k - 1 + before / (before - x)) * step;
      dem.advance(10 * step);
      c.restitution = (dem.seed_state(1).velocity.x - dem.seed_state(0).velocity.x) / speed;
      return c;
    }
    before = x;
  }
}

// Table 3's seed on seed. 0.1 % is the claim of the issue; the step of a 6000th of the contact leaves less.
TEST(Collision, HeadOnEqualsIndependentIntegration) {
  const double mass = test::single_sphere().mass;
  const auto pair = test::Pair::spheres(seed, seed, radius, radius, mass, mass);
  for (const double speed : {0.1, 0.3, 1.0, 3.0}) {
    const test::HeadOn expected = test::head_on(pair, 0.526, speed);
    const Collision c = collide(speed, expected.time / 6000, {});
    std::printf("%.1f m/s: restitution %.5f, contact %.4f us (%.4f), depth %.5f um (%.5f)\n", speed,
                c.restitution, 1e6 * c.time, 1e6 * expected.time, 1e6 * c.depth, 1e6 * expected.depth);
    EXPECT_NEAR(expected.rebound / speed, 0.526, 1e-5);
    EXPECT_NEAR(c.restitution, 0.526, 1e-3 * 0.526);
    EXPECT_NEAR(c.time, expected.time, 1e-3 * expected.time);
    EXPECT_NEAR(c.depth, expected.depth, 1e-3 * expected.depth);
  }
}

// The reduced modulus: restitution stays, the contact lasts factor^(-2/5) times as long and the overlap grows
// by the same factor (dimensional analysis of the impact), here up to 1.3 % of the radius.
TEST(Collision, ReducedModulusKeepsTheRestitution) {
  const double speed = 0.3;
  const Collision full = collide(speed, 2e-8, {});
  for (const double factor : {0.1, 0.01}) {
    const double slower = std::pow(factor, -0.4);
    const Collision c = collide(speed, 2e-8 * slower, {}, factor);
    std::printf("G x %g: restitution %.5f, contact %.1f us, overlap %.2f %% of the radius\n", factor,
                c.restitution, 1e6 * c.time, 100 * c.depth / radius);
    EXPECT_NEAR(c.restitution, full.restitution, 1e-6);
    EXPECT_NEAR(c.time, slower * full.time, 1e-6 * c.time);
    EXPECT_NEAR(c.depth, slower * full.depth, 1e-6 * c.depth);
  }
}

// Viscoelastic: e = 0.526 at 1 m/s, more below and less above, by the series of Schwager & Poeschel through
// the same material constant (their series is good to b^4, b = 3/2 A/T).
TEST(Collision, ViscoelasticRestitutionFallsWithTheSpeed) {
  ContactProperties p;
  p.restitution = 0.9;
  p.restitution_law = "viscoelastic";
  double last = 1;
  for (const double speed : {0.01, 0.1, 1.0, 3.0}) {
    const double b = 1.5 * dissipation_of(0.9) * std::pow(speed, 0.2);
    const double series = 1 - 1.15344 * b + 0.79826 * b * b - 0.48358 * b * b * b;
    const Collision c = collide(speed, 1e-8 * std::pow(speed, -0.2), p);
    std::printf("%.2f m/s: viscoelastic restitution %.5f, series %.5f\n", speed, c.restitution, series);
    EXPECT_NEAR(c.restitution, series, 0.4 * std::pow(b, 4) + 5e-4);
    EXPECT_LT(c.restitution, last);
    last = c.restitution;
  }
}

struct Oblique {
  Vec3 velocity, spin;
};

ContactProperties friction_only(double e, double mu) {
  ContactProperties p;
  p.restitution = e;
  p.static_friction = mu;
  p.rolling_friction = 0;
  return p;
}

Oblique against_plane(const Vec3& velocity, double e, double mu, double step, double factor = 1) {
  Dem dem(weightless(step));
  Material soft = seed, plate = resin;
  soft.shear_modulus *= factor, plate.shear_modulus *= factor;
  const int a = dem.add_material(soft), b = dem.add_material(plate);
  dem.set_contact(a, b, friction_only(e, mu));
  dem.add_template(test::single_sphere(), a, true);
  dem.add_wall({"plane", {}, {0, 0, 1}, {}, b});
  dem.add_seed(0, {0, 0, radius}, {}, velocity);
  do dem.advance(step);
  while (dem.n_contacts() > 0 || dem.seed_state(0).velocity.z < 0);
  return {dem.seed_state(0).velocity, dem.seed_state(0).spin};
}

/// The same impact by an integrator of its own: normal motion by Runge-Kutta, friction by tiny steps. The
/// contact point is where the plane is, R - x below the centre.
Oblique integrated(const Vec3& velocity, double e, double mu, const test::Pair& p) {
  const double k = 4.0 / 3 * p.young * std::sqrt(p.radius), beta = test::damping_ratio(e);
  const double h = 3.3 * std::pow(p.mass * p.mass / (k * k * -velocity.z), 0.2) / 200000;
  const double inertia = 0.4 * p.mass * radius * radius;
  std::array<double, 2> y{0, -velocity.z};
  double spring = 0, speed = velocity.x, spin = 0;
  const auto f = [&](const std::array<double, 2>& z) {
    const double x = std::max(z[0], 0.0), root = std::sqrt(x);
    return std::array<double, 2>{z[1],
                                 -(k * x * root + beta * std::sqrt(5 * p.mass * k * root) * z[1]) / p.mass};
  };
  do {
    test::runge_kutta(y, h, f);
    const double x = std::max(y[0], 0.0), stiffness = 8 * p.shear * std::sqrt(p.radius * x);
    const double limit = mu * k * x * std::sqrt(x), lever = radius - x, slip = speed - lever * spin;
    spring += h * slip;
    double force = -stiffness * spring;
    if (std::abs(force) > limit) {
      force = std::copysign(limit, force);
      spring = stiffness > 0 ? -force / stiffness : 0;
    } else {
      force -= beta * std::sqrt(10.0 / 3 * p.mass * stiffness) * slip;
      force = std::copysign(std::min(std::abs(force), limit), force);
    }
    speed += h * force / p.mass;
    spin -= h * lever * force / inertia;
  } while (y[0] > 0);
  return {{speed, 0, -y[1]}, {0, spin, 0}};
}

// Nine angles at 1 m/s, seed on resin (Table 3). Where the impact slides throughout, the tangential impulse
// is mu (1 + e) m v_n (0.1 %, the issue asks for 1 %); at all angles velocity and spin equal the
// integration's (0.2 % of the incoming speed: the sphere in the DEM also turns its contact point by the
// overlap).
TEST(Collision, ObliqueImpactOnAPlane) {
  const double e = 0.627, mu = 0.41, mass = test::single_sphere().mass;
  const auto pair = test::Pair::spheres(seed, resin, radius, 1e9, mass, 1e9);
  // Slides from first touch to the end if 8 G* u > mu 4/3 E* v_n all the time; u loses 7/2 mu (1 + e) v_n.
  const double from_start = mu * pair.young / (6 * pair.shear);
  int n_sliding = 0;
  for (int k = 0; k < 9; ++k) {
    const double angle = (5 + 10 * k) * M_PI / 180;
    const Vec3 v{std::sin(angle), 0, -std::cos(angle)};
    const Oblique c = against_plane(v, e, mu, 1e-8), expected = integrated(v, e, mu, pair);
    const double impulse = v.x - c.velocity.x, sliding = mu * (1 + e) * -v.z;
    const bool slides = v.x - 3.5 * sliding > from_start * -v.z;
    n_sliding += slides;
    std::printf("%2d deg: v_t %.5f (%.5f), spin %.2f (%.2f), impulse / mu (1 + e) v_n %.5f %s\n", 5 + 10 * k,
                c.velocity.x, expected.velocity.x, c.spin.y, expected.spin.y, impulse / sliding,
                slides ? "sliding" : "");
    if (slides) {
      EXPECT_NEAR(impulse, sliding, 1e-3 * sliding);
    }
    EXPECT_NEAR(c.velocity.x, expected.velocity.x, 5e-4);
    EXPECT_NEAR(c.velocity.z, expected.velocity.z, 5e-4);
    EXPECT_NEAR(c.spin.y * radius, expected.spin.y * radius, 5e-4);
  }
  EXPECT_GE(n_sliding, 2);
  EXPECT_LE(n_sliding, 7);
}

// A hundredth of the modulus leaves the sliding impulse as it is.
TEST(Collision, ReducedModulusKeepsTheSlidingImpulse) {
  const double e = 0.627, mu = 0.41;
  const Vec3 v{0.3 * std::sin(1.3), 0, -0.3 * std::cos(1.3)};
  for (const double factor : {1.0, 0.01}) {
    const double impulse = v.x - against_plane(v, e, mu, 2e-8 * std::pow(factor, -0.4), factor).velocity.x;
    EXPECT_NEAR(impulse, mu * (1 + e) * -v.z, 1e-3 * mu * (1 + e) * -v.z) << factor;
  }
}

}  // namespace
}  // namespace seedflow
