#include "seedflow/seeds/contact_law.h"

#include <gtest/gtest.h>

#include <random>

namespace seedflow {
namespace {

// The law is one template: each lane must do what the scalar law does, gaps and sliding contacts side by side.
TEST(ContactLaw, LanesDoWhatOneContactDoes) {
  const ContactLaw law({"a", 1340, 0.4, 1.5e8}, {"b", 1800, 0.35, 1.3e9}, {0.526, 0.297, 0.03});
  std::mt19937 random(5);
  std::uniform_real_distribution<double> u(-1, 1);
  for (int repeat = 0; repeat < 20; ++repeat) {
    ContactKinematics<Lanes> lanes;
    ContactMemory<Lanes> memory;
    ContactKinematics<double> one[lane_width];
    ContactMemory<double> own[lane_width];
    for (int i = 0; i < lane_width; ++i) {
      ContactKinematics<double>& c = one[i];
      const Vec3 n{u(random), u(random), u(random)};
      c.normal = n / norm(n);
      c.overlap = 1e-5 * u(random);
      c.reduced_radius = 1e-3 * (2 + u(random));
      c.reduced_mass = 1e-5 * (2 + u(random));
      c.velocity = {u(random), u(random), u(random)};
      c.spin = {100 * u(random), 100 * u(random), 100 * u(random)};
      c.rolling_radius = 1e-3;
      c.inertia = 1e-11;
      own[i].spring = {1e-6 * u(random), 1e-6 * u(random), 1e-6 * u(random)};
      lanes.normal.set(i, c.normal), lanes.velocity.set(i, c.velocity), lanes.spin.set(i, c.spin);
      lanes.overlap[i] = c.overlap, lanes.reduced_radius[i] = c.reduced_radius;
      lanes.reduced_mass[i] = c.reduced_mass, lanes.rolling_radius[i] = c.rolling_radius;
      lanes.inertia[i] = c.inertia;
      memory.spring.set(i, own[i].spring);
    }
    with_models(law, [&](auto rolling, auto cohesion) {
      const auto all = contact_action<rolling(), cohesion()>(law, lanes, 1e-6, memory);
      for (int i = 0; i < lane_width; ++i) {
        const auto single = contact_action<rolling(), cohesion()>(law, one[i], 1e-6, own[i]);
        EXPECT_LE(norm(all.force.get(i) - single.force), 1e-13 * norm(single.force));
        EXPECT_LE(norm(all.torque.get(i) - single.torque), 1e-13 * norm(single.torque));
        EXPECT_LE(norm(memory.spring.get(i) - own[i].spring), 1e-13 * norm(own[i].spring));
        if (one[i].overlap <= 0) {
          EXPECT_EQ(norm(single.force), 0);
          EXPECT_EQ(norm(single.torque), 0);
          EXPECT_EQ(norm(own[i].spring), 0);
        }
      }
    });
  }
}

}  // namespace
}  // namespace seedflow
