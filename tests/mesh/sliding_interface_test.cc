#include "seedflow/mesh/sliding_interface.h"

#include <gtest/gtest.h>

#include "rotor_mesh.h"
#include "seedflow/base/error.h"

namespace seedflow {
namespace {

const double angles[] = {0, 0.1, 0.777, 2.5, 6.5, -40};

/// Largest distance between the two points, one per side, that belong to a quadrature point.
template <int dim>
double gap(const SlidingInterface<dim>& s) {
  double largest = 0;
  for (const auto& piece : s.pieces())
    for (auto q = piece.begin; q < piece.end; ++q) {
      const auto a = s.at(s.faces()[piece.face[0]], s.points()[q].at[0]);
      const auto b = s.at(s.faces()[piece.face[1]], s.points()[q].at[1]);
      largest = std::max(largest, a.position.distance(b.position));
    }
  return largest;
}

/// Pieces of a closed ring cover both sides; weights of the pieces sum to the faces.
TEST(SlidingInterfaceMpi, RingIsCoveredAtAnyAngle) {
  const auto domain = ring(0.4, 0.7, 1, 9, 14, 1, 1);
  refine_some(*domain);
  SlidingInterface<2> s(*domain, 1);
  for (const double angle : angles) {
    s.turn_to(angle);
    std::vector<double> sum(s.faces().size(), 0.0);
    for (const auto& piece : s.pieces())
      for (auto q = piece.begin; q < piece.end; ++q)
        for (int side = 0; side < 2; ++side) sum[piece.face[side]] += s.points()[q].weight;
    for (std::size_t i = 0; i < sum.size(); ++i) {
      EXPECT_NEAR(sum[i], s.faces()[i].area, 1e-14) << angle;
      EXPECT_EQ(s.faces()[i].uncovered(), 0) << angle;
    }
    // A chord over an angle t lies R (1 - cos(t/2)) = 0.0426 inside the circle for the longest, pi/9.
    EXPECT_LT(gap(s), 0.7 * (1 - std::cos(dealii::numbers::PI / 18)) + 1e-12);
  }
}

/// In a plane: the two sides' points coincide, outward normals are opposite, and the overlap of a small
/// square with a large one is the small square, whatever the angle.
TEST(SlidingInterfaceMpi, SquareOnSquare) {
  const auto domain = blocks(0.5, 3, 1, 4, 0.1);
  refine_some(*domain);
  SlidingInterface<3> s(*domain, 1);
  for (const double angle : angles) {
    s.turn_to(angle);
    double covered = 0, uncovered = 0, moment = 0;
    for (const auto& f : s.faces()) {
      if (f.side == SlidingInterface<3>::rotor) {
        EXPECT_NEAR(f.covered, f.area, 1e-13);
      }
      if (f.side == SlidingInterface<3>::stator) uncovered += f.uncovered();
    }
    for (const auto& piece : s.pieces())
      for (auto q = piece.begin; q < piece.end; ++q) {
        const auto a = s.at(s.faces()[piece.face[0]], s.points()[q].at[0]);
        const auto b = s.at(s.faces()[piece.face[1]], s.points()[q].at[1]);
        EXPECT_LT((a.normal + b.normal).norm(), 1e-13);
        EXPECT_NEAR(a.normal[2], 1, 1e-13);
        covered += s.points()[q].weight;
        moment += s.points()[q].weight * a.position[0] * a.position[0];
      }
    EXPECT_LT(gap(s), 1e-13);
    EXPECT_NEAR(covered, 1, 1e-13);
    EXPECT_NEAR(uncovered, 3, 1e-12);
    EXPECT_NEAR(moment, 1. / 12, 1e-13);  // of a square of edge 1, the same about any axis
  }
}

/// Turning there and back gives the same vertices to the last bit; the interface follows the domain.
TEST(SlidingInterface, TurnsBackExactly) {
  const auto domain = blocks(0.5, 2, 1, 2, 0.1);
  refine_some(*domain);
  const auto before = domain->triangulation().get_vertices();
  const double volume = domain->volume();
  for (const double angle : {0.3, 1.9, -2.2}) {
    domain->turn_to(angle);
    EXPECT_NEAR(domain->volume(), volume, 1e-13);
    SlidingInterface<3> built_here(*domain, 1), turned(*domain, 1);
    turned.turn_to(0);
    turned.turn_to(angle);
    EXPECT_EQ(built_here.pieces().size(), turned.pieces().size());
  }
  domain->turn_to(0);
  EXPECT_TRUE(before == domain->triangulation().get_vertices());
}

TEST(SlidingInterface, RadiiThatDoNotMatchAreNamed) {
  auto domain = ring(0.4, 0.7, 1, 8, 8, 1, 0);
  Rotor<2> rotor = *domain->rotor();
  rotor.pairs = {{"inner", "stator side"}};
  domain->set_rotor(rotor);
  try {
    SlidingInterface<2> s(*domain, 1);
    FAIL();
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("0.4"), std::string::npos) << e.what();
    EXPECT_NE(std::string(e.what()).find("0.7"), std::string::npos) << e.what();
  }
  rotor.pairs = {{"stator side", "rotor side"}};
  domain->set_rotor(rotor);
  EXPECT_THROW(SlidingInterface<2>(*domain, 1), InputError);
  rotor.pairs = {{"rotor sde", "stator side"}};
  EXPECT_THROW(domain->set_rotor(rotor), InputError);
  rotor.material = 5;
  EXPECT_THROW(domain->set_rotor(rotor), InputError);
}

}  // namespace
}  // namespace seedflow
