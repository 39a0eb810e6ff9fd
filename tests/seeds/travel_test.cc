// How long contact lists last, and the speeds that come one substep late.

#include "seedflow/seeds/travel.h"

#include <gtest/gtest.h>

#include "sample_templates.h"
#include "seedflow/seeds/late_maximum.h"

namespace seedflow {
namespace {

constexpr double skin = 1e-3;

struct TwoSpheres {
  std::vector<SeedStore> stores = std::vector<SeedStore>(1);
  SeedShare share{MPI_COMM_SELF};
  Travel travel;

  TwoSpheres() {
    stores[0].model = test::single_sphere();
    stores[0].rigid = true;
    stores[0].add(0, {}, {}, {}, {});
    stores[0].add(1, {0.1, 0, 0}, {}, {}, {});
    share.extend(stores);
    travel.begin(stores, share, skin);
  }
  /// The first sphere is now so far from where it was [m].
  void displace(double way) { stores[0].body[0].position.set(0, {0, way, 0}); }
};

// From rest under a constant force the ways of the substeps are as 1, 3, 5, ...: the warning comes before the
// sum passes the skin.
TEST(Travel, ForeseesTheNextSubstep) {
  for (const double first : {1e-9, 1e-6, 4e-5, 1.5e-4}) {
    TwoSpheres s;
    EXPECT_FALSE(s.travel.may_exceed());
    double sum = 0, way = first;
    for (int k = 0; !s.travel.may_exceed(); ++k, way += 2 * first) s.travel.add(way), sum += way;
    EXPECT_LE(2 * sum, skin * (1 + 1e-12)) << "two spheres approach each other twice as fast";
    s.displace(sum);
    EXPECT_FALSE(s.travel.exceeded(s.stores, s.share));
  }
}

// The bound by the largest speed is replaced by what has really been gone.
TEST(Travel, IsMeasuredWhenTheBoundIsReached) {
  TwoSpheres s;
  s.displace(0.7 * skin);
  s.travel.add(0.55 * skin);
  EXPECT_FALSE(s.travel.exceeds(s.stores, s.share)) << "one sphere alone has come by 0.7";
  s.displace(0.8 * skin);
  s.travel.add(0.55 * skin);
  EXPECT_TRUE(s.travel.exceeds(s.stores, s.share));
}

// A jump that was not foreseen is noticed afterwards.
TEST(Travel, NoticesAJump) {
  TwoSpheres s;
  s.travel.add(1e-9);
  EXPECT_FALSE(s.travel.may_exceed());
  s.displace(1.2 * skin);
  s.travel.add(1.2 * skin);
  EXPECT_TRUE(s.travel.exceeded(s.stores, s.share));
}

TEST(LateMaximumMpi, IsThatOfAllRanks) {
  int running = 0;
  MPI_Initialized(&running);
  const SeedShare share(running ? MPI_COMM_WORLD : MPI_COMM_SELF);
  LateMaximum maximum;
  EXPECT_FALSE(maximum.is_pending());
  for (int round = 0; round < 3; ++round) {
    maximum.start(share, 10 * round + share.rank());
    EXPECT_TRUE(maximum.is_pending());
    EXPECT_EQ(maximum.finish(), 10 * round + share.n_ranks() - 1);
    EXPECT_FALSE(maximum.is_pending());
  }
}

}  // namespace
}  // namespace seedflow
