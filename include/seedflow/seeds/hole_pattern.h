#pragma once

#include <array>
#include <string>
#include <variant>
#include <vector>

namespace seedflow {

/// A point of the plate's plane [m].
using PlatePoint = std::array<double, 2>;

/// Rows of holes around `centre`. Rows lie along the first coordinate, `pitch_across` apart; staggered: every
/// second row is shifted by half a pitch.
struct HoleLattice {
  double pitch_along = 0, pitch_across = 0;  ///< [m]
  int n_along = 0, n_across = 0;             ///< holes in a row, rows
  bool staggered = false;
  PlatePoint centre{0, 0};
};

/// Holes evenly spaced on a circle around the plate's centre.
struct HoleRing {
  int n = 0;
  double pitch_radius = 0;  ///< [m]
  double first_angle = 0;   ///< of hole 0, from the plate's first direction [rad]
};

/// Holes wherever they are. make_grid() sorts them into square cells, so that a look-up costs the same for
/// any number of holes.
struct HoleList {
  std::vector<PlatePoint> centre;

  /// `reach` [m]: how far from a hole's centre it shall be found.
  void make_grid(double reach);
  int nearest(const PlatePoint& x) const;

 private:
  PlatePoint low{0, 0};
  double cell = 0;
  std::array<int, 2> n{0, 0};
  std::vector<int> first, member;
};

using HolePattern = std::variant<std::monostate, HoleLattice, HoleRing, HoleList>;

int n_holes(const HolePattern& pattern);
PlatePoint hole_centre(const HolePattern& pattern, int hole);
/// The hole that x may lie in: of two holes that do not overlap the one with the nearer centre; -1 if there
/// is none nearby. The cost does not depend on the number of holes.
int nearest_hole(const HolePattern& pattern, const PlatePoint& x);
/// The least distance between the centres of two holes [m]; 1e300 with fewer than two holes.
double least_hole_distance(const HolePattern& pattern);

}  // namespace seedflow
