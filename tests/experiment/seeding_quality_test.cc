#include "seedflow/experiment/seeding_quality.h"

#include <gtest/gtest.h>

namespace seedflow {
namespace {

// Newcombe (1998), Stat. Med. 17, 857-872, Table I: 81 of 263 is 0.2553 to 0.3662; 0 of 20 is 0 to 0.1611.
TEST(SeedingQuality, WilsonIntervals) {
  const Share many = share_of(81, 263), none = share_of(0, 20);
  EXPECT_NEAR(many.value, 81.0 / 263, 1e-12);
  EXPECT_NEAR(many.low, 0.2553, 5e-5);
  EXPECT_NEAR(many.high, 0.3662, 5e-5);
  EXPECT_EQ(none.low, 0);
  EXPECT_NEAR(none.high, 0.1611, 5e-5);
  EXPECT_EQ(share_of(0, 0).high, 1);
}

TEST(SeedingQuality, HolesWithNoneOneAndMore) {
  const SeedingIndices i = indices_of_counts({1, 1, 0, 2, 1, 3, 1, 1, 1, 1});
  EXPECT_EQ(i.n, 10);
  EXPECT_NEAR(i.quality.value, 0.7, 1e-12);
  EXPECT_NEAR(i.multiple.value, 0.2, 1e-12);
  EXPECT_NEAR(i.miss.value, 0.1, 1e-12);
}

// Limits of ISO 7256-1: half a spacing belongs to the multiples, one and a half still to the good ones.
TEST(SeedingQuality, SpacingsOnTheGround) {
  const SeedingIndices i = indices_of_spacings({0.05, 0.0501, 0.1, 0.11, 0.15, 0.151, 0.2, 0.0}, 0.1);
  EXPECT_EQ(i.n, 8);
  EXPECT_NEAR(i.multiple.value, 2.0 / 8, 1e-12);
  EXPECT_NEAR(i.miss.value, 2.0 / 8, 1e-12);
  EXPECT_NEAR(i.quality.value, 4.0 / 8, 1e-12);
  // Standard deviation of 50.1, 100, 110, 150 mm over 100 mm.
  EXPECT_NEAR(i.precision, 0.410, 1e-3);
}

TEST(SeedingQuality, SpacingsFollowFromTimesInAnyOrder) {
  const auto gaps = spacings({0.3, 0.1, 0.2}, 3);
  ASSERT_EQ(gaps.size(), 2u);
  EXPECT_NEAR(gaps[0], 0.3, 1e-12);
  EXPECT_NEAR(gaps[1], 0.3, 1e-12);
}

}  // namespace
}  // namespace seedflow
