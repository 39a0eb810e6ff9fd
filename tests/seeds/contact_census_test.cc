#include "seedflow/seeds/contact_census.h"

#include <gtest/gtest.h>

#include <cmath>

namespace seedflow {
namespace {

constexpr double gravity = 9.81, radius = 0.4e-3;
const Material material{"seed", 1340, 0.4, 1.5e6};

/// A rigid seed with three feet below and three above, flat enough for its axis to stay z.
SeedTemplate footstool() {
  SeedTemplate t;
  t.name = "footstool";
  for (const double side : {-1.0, 1.0})
    for (int i = 0; i < 3; ++i) {
      const double angle = 2 * M_PI * i / 3;
      t.position.push_back({1.5e-3 * std::cos(angle), 1.5e-3 * std::sin(angle), side * 0.9e-3});
      t.radius.push_back(radius);
    }
  t.seed_volume = M_PI / 6 * 6.4e-8;
  t.seed_density = 1340;
  t.seed_semi_axes = Vec3{2e-3, 2e-3, 2e-3};
  t.finish();
  return t;
}

/// Hertz: F = 4/3 E* sqrt(R*) delta^(3/2).
double overlap_under(double force, double reduced_radius) {
  const double young = material.shear_modulus / (1 - material.poisson_ratio);  // E* of two equal bodies
  return std::pow(0.75 * force / (young * std::sqrt(reduced_radius)), 2.0 / 3);
}

TEST(ContactCensus, TwoSeedsOnTopOfEachOther) {
  DemParameters p;
  p.time_step = 1e-6;
  Dem dem(p);
  const int m = dem.add_material(material);
  dem.set_contact(m, m, {0.3, 0.3, 0});
  dem.add_template(footstool(), m, true);
  dem.add_wall(Wall("floor", Plane{{0, 0, 0}, {0, 0, 1}}, m));
  const double height = 0.9e-3 + radius;
  EXPECT_EQ(contact_census(dem).n_contacts, 0);
  dem.add_seed(0, {0, 0, height});
  dem.add_seed(0, {0, 0, 3 * height});
  dem.advance(0.05);

  const double foot = dem.seed_template(0).mass * gravity / 3;
  const double below = overlap_under(2 * foot, radius) / radius,
               between = overlap_under(foot, radius / 2) / radius;
  const ContactCensus census = contact_census(dem);
  EXPECT_EQ(census.n_contacts, 6);
  // The seeds' oscillation has faded to less than a thousandth of its first amplitude.
  EXPECT_NEAR(census.largest_overlap, std::max(below, between), 2e-3 * below);
  EXPECT_NEAR(census.mean_overlap, 0.5 * (below + between), 2e-3 * below);
  EXPECT_DOUBLE_EQ(census.neighbours_per_seed, 1.5);
  EXPECT_DOUBLE_EQ(census.contacts_per_pair, 3);
}

}  // namespace
}  // namespace seedflow
