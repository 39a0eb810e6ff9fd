#pragma once

#include <vector>

#include "seedflow/base/vector.h"

namespace seedflow {

/// A suction hole and the seeds in front of it as two orifices in series: the curtain between the hole's rim
/// and the seeds' surfaces (area A_c), then the hole itself (A_h). With Bernoulli's equation and a discharge
/// coefficient each,
///   dp = rho/2 Q^2 (1/(C_c A_c)^2 + 1/(C_h A_h)^2),   A_e = C_c A_c C_h A_h / sqrt((C_c A_c)^2 + (C_h
///   A_h)^2), Q = A_e sqrt(2 dp/rho),
/// and the part of dp that is lost in the curtain, so that the mouth of the hole behind it is below ambient
/// by chi dp, is
///   chi = (C_h A_h)^2 / ((C_h A_h)^2 + (C_c A_c)^2):
/// 1 for a seed that seals the hole, (A_h/A_c)^2 -> 0 for one far away. The force on a seed is chi dp times
/// the vector area of the part of its surface that looks into the mouth; this part is bounded by the places
/// of the seed nearest to the rim. For a seated ball that is the area inside the rim, so that the holding
/// force is dp x (area of the seat).
///
/// Rim: the circle on which a ball of the seeds' radius R sits. With a chamfer of 45 degrees, width c, around
/// the hole's radius a that is the radius b = R/sqrt(2), but not outside [a, a + c], at the depth a + c - b.
/// Gaps are those to the nearest seed, smoothly: G^-4 = sum over seeds of g^-4; each seed carries the share
/// (G/g)^4 of the rim. No gap is smaller than the roughness of the seat. Balls stand for whole seeds.
///
/// Validity: gaps of up to about the hole's radius, where the curtain is the narrowest place; farther away
/// only the order of magnitude and the decay (as r^-4) are right, at forces far below a seed's weight. Mach
/// numbers below a third, i.e. dp below 7.5 kPa. The momentum of the air along the seed's surface is
/// neglected.
struct CoveredHole {
  double radius = 0;                       ///< a [m]
  double seat_radius = 0, seat_depth = 0;  ///< of the rim [m]; depth behind the front face
  double hole_coefficient = 0.8;           ///< C_h [1]
  double gap_coefficient = 0.8;            ///< C_c [1]
  double roughness = 20e-6;                ///< smallest gap [m]
  static constexpr int rim_points = 24;

  CoveredHole() = default;
  CoveredHole(double hole_radius, double chamfer, double seed_radius);

  /// A seed near the hole: centre from the centre of the hole's mouth, z towards the seeds [m].
  struct Ball {
    Vec3 centre;
    double radius = 0;
  };
  struct Outcome {
    double gap_area = 1e300;      ///< A_c [m2]
    double cover = 0;             ///< chi [1]
    double flow_area = 0;         ///< A_e [m2]
    std::vector<Vec3> area = {};  ///< vector area of each ball that chi dp acts on [m2]: force = chi dp area
  };
  /// \param exposure part of the hole that opens into the vacuum, in [0, 1]
  Outcome evaluate(const std::vector<Ball>& balls, double exposure) const;
};

}  // namespace seedflow
