#include "seedflow/seeds/template_bonds.h"

#include <gtest/gtest.h>

#include <string>

#include "seedflow/base/error.h"

namespace seedflow {
namespace {

/// Four spheres of radius 1 mm in a row: gaps between the centres 2, 2.4 and 3 mm.
SeedTemplate row() {
  SeedTemplate seed;
  seed.name = "row";
  seed.position = {{0, 0, 0}, {2e-3, 0, 0}, {4.4e-3, 0, 0}, {7.4e-3, 0, 0}};
  seed.radius.assign(4, 1e-3);
  return seed;
}

TEST(TemplateBonds, PairsNearerThanTheirContactRadii) {
  SeedTemplate seed = row();
  seed.radius[1] = 0.5e-3;
  bond_by_contact_radius(seed, 1.7, 0.8);
  ASSERT_EQ(seed.bond.size(), 3u);
  EXPECT_EQ(seed.bond[0].first, 0);
  EXPECT_EQ(seed.bond[0].second, 1);
  EXPECT_DOUBLE_EQ(seed.bond[0].radius, 0.8 * 0.5e-3);
  EXPECT_DOUBLE_EQ(seed.bond[2].radius, 0.8 * 1e-3);
  bond_by_contact_radius(seed, 1.59, 1);  // 1.59 * 1.5 mm = 2.385 mm: pair 1-2 is lost
  EXPECT_EQ(seed.bond.size(), 2u);
}

TEST(TemplateBonds, ConnectingFactorIsTheLongestEdgeOfTheSpanningTree) {
  EXPECT_DOUBLE_EQ(connecting_contact_factor(row()), 1.5);
  SeedTemplate one = row();
  one.position.resize(1);
  one.radius.resize(1);
  EXPECT_EQ(connecting_contact_factor(one), 0);
  EXPECT_NO_THROW(require_one_piece(one));
}

TEST(TemplateBonds, PiecesAreRejectedWithTheRadiusThatConnectsThem) {
  SeedTemplate seed = row();
  bond_by_contact_radius(seed, 1.1, 1);
  try {
    require_one_piece(seed);
    FAIL();
  } catch (const InputError& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("3 pieces"), std::string::npos) << message;
    EXPECT_NE(message.find("factor 1.5001"), std::string::npos) << message;
  }
  bond_by_contact_radius(seed, 1.5001, 1);
  EXPECT_NO_THROW(require_one_piece(seed));
  EXPECT_THROW(bond_by_contact_radius(seed, 0, 1), InputError);
  EXPECT_THROW(bond_by_contact_radius(seed, 1, -1), InputError);
}

}  // namespace
}  // namespace seedflow
