#pragma once

#include "seedflow/experiment/curve_fit.h"
#include "seedflow/experiment/view.h"

namespace seedflow {

/// How the surface of the bed in a drum is read off its picture.
struct BedContourSettings {
  double pixel = 0.1e-3;     ///< edge of a pixel [m]
  double fitted_part = 0.7;  ///< of half the surface's width, about its middle, for the straight line [1]
};

/// The dynamic contour of a bed (the source paper's Figs. 9 and 18).
struct BedContour {
  Silhouette::Boundary boundary;  ///< of the bed, seen from above [m]
  CurveFit line;                  ///< y = p0 + p1 x over the middle part
  CurveFit cubic;           ///< y/s = p0 + p1 u + p2 u^2 + p3 u^3, u = (x - middle)/s, s = half the width
  double angle = 0;         ///< dynamic angle of repose, arctan p1 of the line [rad]; positive: rises with x
  double middle_angle = 0;  ///< slope of the cubic at the middle of the surface [rad]
  double middle = 0, half = 0;  ///< of the surface along x [m]
  double line_from = 0, line_to = 0;

  /// The fitted S-shaped surface at x [m].
  double surface(double x) const;
};

/// Fits the upper boundary of the seeds' picture by Levenberg-Marquardt: a straight line to its middle part
/// and a cubic (S shape) to all of it. Columns where the boundary lies on the drum's wall, within `rim` of
/// the circle about `axis` (x, y in the picture) with the given radius, are left out. Errors: RunError if
/// there is no surface.
BedContour bed_contour(const std::vector<Disc>& discs, double axis_x, double axis_y, double radius,
                       double rim, const BedContourSettings& settings);
BedContour bed_contour(const Silhouette::Boundary& boundary, double axis_x, double axis_y, double radius,
                       double rim, const BedContourSettings& settings);

}  // namespace seedflow
