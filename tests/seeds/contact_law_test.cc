#include "seedflow/seeds/contact_law.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "seedflow/base/error.h"
#include "seedflow/seeds/restitution.h"

namespace seedflow {
namespace {

const Material seed{"seed", 1340, 0.4, 1.5e8}, resin{"resin", 1800, 0.35, 1.3e9};

ContactProperties cohesive(const std::string& model) {
  ContactProperties p;
  p.cohesion = model;
  if (model == "JKR") p.surface_energy = 0.5;
  if (model == "capillary bridge") p.surface_tension = 0.072, p.contact_angle = 0.4, p.bridge_volume = 2e-11;
  return p;
}

ContactKinematics<double> pressed(double overlap, double radius = 1e-3) {
  ContactKinematics<double> c;
  c.normal = {0, 0, 1};
  c.overlap = overlap;
  c.reduced_radius = radius;
  c.reduced_mass = 2e-5;
  c.rolling_radius = radius;
  c.inertia = c.contact_inertia = 1e-11;
  return c;
}

// The law is one template: each lane must do what the law of one contact does, whatever the models, with
// gaps, sticking and sliding contacts side by side.
TEST(ContactLaw, LanesDoWhatOneContactDoes) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> u(-1, 1);
  for (const char* rolling_model : {"none", "constant torque", "EPSD"})
    for (const char* cohesion_model : {"none", "JKR", "capillary bridge"})
      for (int repeat = 0; repeat < 20; ++repeat) {
        ContactProperties p = cohesive(cohesion_model);
        p.rolling_model = rolling_model;
        if (p.cohesion == "none" && repeat % 2) p.tangential_model = "Mindlin with partial slip";
        const ContactLaw law(seed, resin, p);
        ContactKinematics<Lanes> lanes;
        ContactMemory<Lanes> memory;
        ContactKinematics<double> one[lane_width];
        ContactMemory<double> own[lane_width];
        for (int i = 0; i < lane_width; ++i) {
          ContactKinematics<double>& c = one[i];
          const Vec3 n{u(random), u(random), u(random)};
          c = pressed(1e-5 * u(random), 1e-3 * (2 + u(random)));
          c.normal = n / norm(n);
          c.reduced_mass = 1e-5 * (2 + u(random));
          c.velocity = {u(random), u(random), u(random)};
          c.spin = {100 * u(random), 100 * u(random), 100 * u(random)};
          c.share = i % 2 ? 0.5 : 1;
          own[i].spring = {1e-6 * u(random), 1e-6 * u(random), 1e-6 * u(random)};
          if (law.rolling == Rolling::epsd)
            own[i].rolling = {1e-4 * u(random), 1e-4 * u(random), 1e-4 * u(random)};
          own[i].attached = law.cohesion != Cohesion::none && i % 3 == 0;
          lanes.normal.set(i, c.normal), lanes.velocity.set(i, c.velocity), lanes.spin.set(i, c.spin);
          lanes.overlap[i] = c.overlap, lanes.reduced_radius[i] = c.reduced_radius;
          lanes.reduced_mass[i] = c.reduced_mass, lanes.rolling_radius[i] = c.rolling_radius;
          lanes.inertia[i] = c.inertia, lanes.contact_inertia[i] = c.contact_inertia;
          lanes.share[i] = c.share;
          memory.spring.set(i, own[i].spring), memory.rolling.set(i, own[i].rolling);
          memory.attached[i] = own[i].attached;
        }
        with_models(law, [&](auto rolling, auto cohesion, auto partial) {
          const auto all = contact_action<rolling(), cohesion(), partial()>(law, lanes, 1e-6, memory);
          for (int i = 0; i < lane_width; ++i) {
            const double attached = own[i].attached;
            const auto single = contact_action<rolling(), cohesion(), partial()>(law, one[i], 1e-6, own[i]);
            EXPECT_LE(norm(all.force.get(i) - single.force), 1e-12 * norm(single.force));
            EXPECT_LE(norm(all.torque.get(i) - single.torque), 1e-12 * norm(single.torque));
            EXPECT_LE(norm(memory.spring.get(i) - own[i].spring), 1e-12 * norm(own[i].spring));
            EXPECT_LE(norm(memory.rolling.get(i) - own[i].rolling), 1e-12 * norm(own[i].rolling));
            EXPECT_NEAR(memory.attached[i], own[i].attached, 1e-15);
            if (one[i].overlap <= 0 && attached == 0) {
              EXPECT_EQ(norm(single.force), 0);
              EXPECT_EQ(norm(single.torque), 0);
              EXPECT_EQ(norm(own[i].spring), 0);
              EXPECT_EQ(norm(own[i].rolling), 0);
            }
          }
        });
      }
}

double force_of(const ContactLaw& law, double overlap, ContactMemory<double>& memory) {
  double force = 0;
  with_models(law, [&](auto rolling, auto cohesion, auto partial) {
    force = contact_action<rolling(), cohesion(), partial()>(law, pressed(overlap), 0, memory).force.z;
  });
  return force;
}

// Johnson, Kendall & Roberts: -4/3 pi w R* when the surfaces meet, -3/2 pi w R* at most, -5/6 pi w R* where
// the contact breaks, and in between the force of the contact radius that solves
// delta = a^2/R* - sqrt(2 pi w a/E*), found here by bisection.
TEST(ContactLaw, JkrPullOffNeckAndForce) {
  const ContactLaw law(seed, seed, cohesive("JKR"));
  const double radius = 1e-3, w = 0.5, unit = M_PI * w * radius, neck = law.reach(radius);
  ContactMemory<double> apart, memory;
  EXPECT_EQ(force_of(law, -0.5 * neck, apart), 0);  // does not act before the surfaces have met
  EXPECT_NEAR(force_of(law, 1e-16, memory), -4.0 / 3 * unit, 1e-6 * unit);
  double strongest = 0;
  for (int k = 0; k <= 2000; ++k) {
    const double overlap = 2 * neck - 3 * neck * k / 2000 * (1 - 1e-9);
    double low = std::pow(0.25 * radius * std::sqrt(2 * M_PI * w / law.young), 2.0 / 3), high = 2e-3;
    for (int i = 0; i < 200; ++i) {
      const double a = 0.5 * (low + high);
      (a * a / radius - std::sqrt(2 * M_PI * w * a / law.young) < overlap ? low : high) = a;
    }
    const double expected = 4.0 / 3 * law.young * low * low * low / radius -
                            std::sqrt(8 * M_PI * w * law.young * low * low * low);
    const double force = force_of(law, overlap, memory);
    EXPECT_NEAR(force, expected, 1e-6 * unit) << overlap;  // at the neck a has a square-root singularity
    strongest = std::min(strongest, force);
  }
  EXPECT_NEAR(strongest, -1.5 * unit, 1e-5 * unit);  // minimum sampled at 2000 points
  EXPECT_NEAR(force_of(law, -neck * (1 - 1e-10), memory), -5.0 / 6 * unit, 1e-4 * unit);
  EXPECT_EQ(force_of(law, -neck * (1 + 1e-9), memory), 0);
  EXPECT_EQ(memory.attached, 0);
  EXPECT_EQ(force_of(law, -0.5 * neck, memory), 0);
}

TEST(ContactLaw, JkrWithoutEnergyIsHertz) {
  ContactProperties p = cohesive("JKR");
  p.surface_energy = 1e-12;
  const ContactLaw jkr(seed, seed, p), hertz(seed, seed, {});
  for (const double overlap : {1e-7, 1e-6, 1e-5}) {
    ContactMemory<double> a, b;
    // The leading correction is of the order sqrt(w).
    EXPECT_NEAR(force_of(jkr, overlap, a), force_of(hertz, overlap, b), 2e-5 * force_of(hertz, overlap, b));
  }
}

// Willett et al. (2000): water between 2 mm spheres. At contact 2 pi R gamma cos(theta), minus nothing of
// Hertz at zero overlap; ruptures at (1 + theta/2)(V^(1/3) + 0.1 V^(2/3)/R), and a gap alone makes no bridge.
TEST(ContactLaw, CapillaryBridge) {
  const ContactLaw law(seed, seed, cohesive("capillary bridge"));
  const double radius = 2e-3, volume = 2e-11, full = 2 * M_PI * radius * 0.072 * std::cos(0.4);
  const double rupture = (1 + 0.2) * (std::cbrt(volume) + 0.1 * std::pow(volume, 2.0 / 3) / radius);
  EXPECT_NEAR(law.reach(1e-3), rupture, 1e-12 * rupture);
  ContactMemory<double> memory, apart;
  EXPECT_EQ(force_of(law, -0.1 * rupture, apart), 0);
  EXPECT_NEAR(force_of(law, 1e-15, memory), -full, 1e-9 * full);
  for (const double part : {0.1, 0.5, 0.999999}) {
    const double s = part * rupture * std::sqrt(radius / volume);
    EXPECT_NEAR(force_of(law, -part * rupture, memory), -full / (1 + 1.05 * s + 2.5 * s * s), 1e-12 * full);
  }
  EXPECT_EQ(force_of(law, -1.000001 * rupture, memory), 0);
  EXPECT_EQ(force_of(law, -0.5 * rupture, memory), 0);
}

// Constant load, monotonic shear: Mindlin & Deresiewicz, s = 3 mu N/(16 G* a) (1 - (1 - T/mu N)^(2/3)); back
// from full sliding the same curve doubled; then sliding the other way.
TEST(ContactLaw, PartialSlipIsMindlinDeresiewicz) {
  ContactProperties p;
  p.tangential_model = "Mindlin with partial slip";
  p.restitution = 1;
  p.rolling_model = "none";
  const ContactLaw law(seed, seed, p);
  ContactKinematics<double> c = pressed(1e-6);
  const double a = std::sqrt(1e-3 * 1e-6), limit = 0.297 * 4.0 / 3 * law.young * a * 1e-6;
  const double scale = 3 * limit / (16 * law.shear * a), speed = 0.01, step = 1e-4 * scale / speed;
  ContactMemory<double> memory;
  const auto force = [&] {
    return contact_action<Rolling::none, Cohesion::none>(law, c, step, memory).force.x;
  };
  c.velocity = {speed, 0, 0};
  for (int k = 1; k <= 9000; ++k) {
    const double expected = -limit * (1 - std::pow(1 - k * 1e-4, 1.5));
    ASSERT_NEAR(force(), expected, 1e-3 * limit) << k;  // first-order steps of 1e-4
  }
  for (int k = 0; k < 3000; ++k) force();
  EXPECT_NEAR(force(), -limit, 1e-9 * limit);
  c.velocity = {-speed, 0, 0};
  for (int k = 1; k <= 19000; ++k) {
    const double expected = -limit + 2 * limit * (1 - std::pow(1 - k * 0.5e-4, 1.5));
    ASSERT_NEAR(force(), expected, 1e-3 * limit) << k;
  }
  for (int k = 0; k < 3000; ++k) force();
  EXPECT_NEAR(force(), limit, 1e-9 * limit);
}

// Series of Schwager & Poeschel for weak dissipation, and the inverse.
TEST(ContactLaw, ViscoelasticRestitution) {
  for (const double a : {0.003, 0.01, 0.03}) {
    const double b = 1.5 * a;
    // The next term of the series is about 0.3 b^4.
    EXPECT_NEAR(viscoelastic_restitution(a), 1 - 1.15344 * b + 0.79826 * b * b - 0.48358 * b * b * b,
                0.4 * std::pow(b, 4) + 1e-6);
  }
  for (const double e : {0.05, 0.526, 0.9, 1.0})
    EXPECT_NEAR(viscoelastic_restitution(dissipation_of(e)), e, 1e-8);
}

TEST(ContactLaw, ContradictoryPropertiesAreRefused) {
  const auto complaint = [](const ContactProperties& p) -> std::string {
    try {
      ContactLaw(seed, resin, p);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  ContactProperties p;
  EXPECT_EQ(complaint(p), "");
  p.cohesion = "JKR";
  EXPECT_NE(complaint(p).find("between 'seed' and 'resin': 'Surface energy' is 0"), std::string::npos);
  p.cohesion = "none";
  p.surface_energy = 0.1;
  EXPECT_NE(complaint(p).find("acts only with 'Cohesion = JKR'"), std::string::npos);
  p = {};
  p.rolling_model = "EPSD";
  p.rolling_friction = 0;
  EXPECT_NE(complaint(p).find("EPSD needs a positive one"), std::string::npos);
  p = {};
  p.rolling_model = "espd";
  EXPECT_NE(complaint(p).find("\"EPSD\""), std::string::npos) << complaint(p);
  p = {};
  p.restitution = 1.2;
  EXPECT_NE(complaint(p).find("'Restitution' is 1.2"), std::string::npos);
}

}  // namespace
}  // namespace seedflow
