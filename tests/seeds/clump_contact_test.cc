// Several sub-sphere contacts between the same two seeds: what they do to stiffness, contact time and
// restitution, and what normalising the contacts changes.

#include <gtest/gtest.h>

#include <cmath>

#include "contact_ode.h"
#include "sample_templates.h"
#include "seedflow/seeds/dem.h"

namespace seedflow {
namespace {

const Material material{"seed", 1340, 0.4, 1.5e8};

/// A rigid seed of the mass of a 4 mm sphere that touches with n equal spheres at once, in a ring on either
/// face.
SeedTemplate faced(int n, double radius) {
  SeedTemplate t;
  t.name = "faced";
  for (const double side : {-1.0, 1.0})
    for (int i = 0; i < n; ++i) {
      const double angle = 2 * M_PI * i / n, ring = n == 1 ? 0 : 1.2e-3;
      t.position.push_back({side * 1.2e-3, ring * std::cos(angle), ring * std::sin(angle)});
      t.radius.push_back(radius);
    }
  t.seed_volume = M_PI / 6 * 6.4e-8;
  t.seed_density = 1340;
  t.seed_semi_axes = Vec3{2e-3, 2e-3, 2e-3};
  t.finish();
  return t;
}

struct Outcome {
  double restitution = 0, time = 0, depth = 0;
};

Outcome collide(int n, bool normalise, double radius, double speed) {
  DemParameters p;
  p.gravity = {};
  p.time_step = 1e-8;
  p.contacts.normalise = normalise;
  Dem dem(p);
  dem.add_template(faced(n, radius), dem.add_material(material), true);
  const double apart = 2 * (1.2e-3 + radius);
  dem.add_seed(0, {0, 0, 0}, {}, {speed / 2, 0, 0});
  dem.add_seed(0, {apart + 1e-12, 0, 0}, {}, {-speed / 2, 0, 0});
  Outcome o;
  double overlap = 0;
  do {
    dem.advance(2e-8);
    overlap = apart - (dem.seed_state(1).centre.x - dem.seed_state(0).centre.x);
    o.depth = std::max(o.depth, overlap);
  } while (overlap > 0);
  o.time = dem.time();
  dem.advance(1e-6);
  o.restitution = (dem.seed_state(1).velocity.x - dem.seed_state(0).velocity.x) / speed;
  return o;
}

// n parallel contacts, each with the seeds' whole m* in its damping: stiffness n k, damping n c, so beta
// becomes sqrt(n) beta, the contact n^(-2/5) times as long (for equal restitution; here integrated with its
// own). Normalised, n contacts are exactly one.
TEST(ClumpContact, ParallelContactsAreTooStiffAndTooDamped) {
  const double radius = 0.4e-3, speed = 0.3, mass = faced(1, radius).mass;
  const double beta = test::damping_ratio(0.526);
  test::Pair pair = test::Pair::spheres(material, material, radius, radius, mass, mass);
  const test::HeadOn ideal =
      test::head_on(test::Pair::spheres(material, material, 2e-3, 2e-3, mass, mass), 0.526, speed);
  std::printf("pair of 4 mm spheres: restitution 0.526, contact %.1f us\n", 1e6 * ideal.time);
  const Outcome one = collide(1, false, radius, speed);
  for (const int n : {1, 2, 3, 5, 8}) {
    const double damped = std::sqrt(n) * beta;
    const double expected = std::exp(-M_PI * damped / std::sqrt(1 - damped * damped));
    test::Pair parallel = pair;
    parallel.young *= n;
    const test::HeadOn integrated = test::head_on(parallel, expected, speed);
    const Outcome raw = collide(n, false, radius, speed), corrected = collide(n, true, radius, speed);
    std::printf("n = %d: restitution %.4f (%.4f), contact %.1f us (%.1f); normalised %.4f, %.1f us\n", n,
                raw.restitution, expected, 1e6 * raw.time, 1e6 * integrated.time, corrected.restitution,
                1e6 * corrected.time);
    EXPECT_NEAR(raw.restitution, expected, 1e-3);
    EXPECT_NEAR(raw.time, integrated.time, 2e-3 * integrated.time);
    EXPECT_NEAR(corrected.restitution, 0.526, 1e-3);
    EXPECT_NEAR(corrected.time, one.time, 2e-3 * one.time);
    EXPECT_NEAR(corrected.depth, one.depth, 2e-3 * one.depth);
  }
}

/// Two rough seeds of sub-spheres on a lattice meet face to face, the second tilted.
struct Rough {
  double restitution = 0, time = 0;
  int contacts = 0;
};

Rough rough(bool rigid, bool normalise, double tilt) {
  DemParameters p;
  p.gravity = {};
  p.time_step = 5e-7;
  p.contacts.normalise = normalise;
  Dem dem(p);
  dem.add_template(test::lattice_seed(), dem.add_material(material), rigid);
  dem.add_seed(0, {0, 0, 0}, {}, {0.15, 0, 0});
  dem.add_seed(0, {4.05e-3, 0, 0}, rotation({0, tilt, 0.6 * tilt}), {-0.15, 0, 0});
  Rough r;
  const double sample = 5e-6, end = rigid ? 3e-3 : 6e-3;
  while (dem.time() < end) {
    dem.advance(sample);
    r.contacts = std::max(r.contacts, dem.n_contacts());
    if (dem.n_contacts() > 0) r.time += sample;
  }
  r.restitution = (dem.seed_state(1).velocity.x - dem.seed_state(0).velocity.x) / 0.3;
  return r;
}

// Rough seeds. Face to face all contacts act together: rigid, the pair rebounds with 0.25 instead of its
// restitution of 0.526, and normalising undoes it. Tilted, the impact is off centre, turns speed into spin
// and touches with one or two sub-spheres at a time: there is little to correct, and this is printed only.
// Bonded seeds are ruled by their soft bonds, with and without.
TEST(ClumpContact, NormalisingRestoresTheRestitutionOfRoughSeeds) {
  const auto show = [](const char* name, double tilt, const Rough& raw, const Rough& corrected) {
    std::printf(
        "%s, tilt %.2f: up to %d contacts; restitution %.3f, in contact %.0f us; normalised %.3f, %.0f us\n",
        name, tilt, raw.contacts, raw.restitution, 1e6 * raw.time, corrected.restitution,
        1e6 * corrected.time);
  };
  for (const double tilt : {0.0, 0.02, 0.1, 0.3}) {
    const Rough raw = rough(true, false, tilt), corrected = rough(true, true, tilt);
    show("rigid ", tilt, raw, corrected);
    if (tilt > 0) continue;
    EXPECT_GE(raw.contacts, 4);
    EXPECT_LT(raw.restitution, 0.3);
    EXPECT_NEAR(corrected.restitution, 0.526, 0.01);  // 250 steps a contact, the number known a step late
    EXPECT_GT(corrected.time, 1.3 * raw.time);
  }
  const Rough raw = rough(false, false, 0), corrected = rough(false, true, 0);
  show("bonded", 0, raw, corrected);
  EXPECT_GT(raw.restitution, 0.75);
  EXPECT_GT(corrected.restitution, 0.75);
}

}  // namespace
}  // namespace seedflow
