#include "seedflow/experiment/bed_contour.h"

#include <cmath>
#include <string>

#include "seedflow/base/error.h"

namespace seedflow {

double BedContour::surface(double x) const {
  const double u = (x - middle) / half;
  const std::vector<double>& p = cubic.parameters;
  return half * (p[0] + u * (p[1] + u * (p[2] + u * p[3])));
}

BedContour bed_contour(const Silhouette::Boundary& boundary, double axis_x, double axis_y, double radius,
                       double rim, const BedContourSettings& settings) {
  BedContour bed;
  for (std::size_t i = 0; i < boundary.x.size(); ++i) {
    const double inner = radius - rim;
    if (std::hypot(boundary.x[i] - axis_x, boundary.y[i] - axis_y) > inner) continue;
    bed.boundary.x.push_back(boundary.x[i]);
    bed.boundary.y.push_back(boundary.y[i]);
  }
  const std::vector<double>&x = bed.boundary.x, &y = bed.boundary.y;
  if (x.size() < 20)
    throw RunError("The picture of the drum shows no free surface (" + std::to_string(x.size()) +
                   " columns): the drum is empty or full.");
  bed.middle = 0.5 * (x.front() + x.back());
  bed.half = 0.5 * (x.back() - x.front());
  bed.line_from = bed.middle - settings.fitted_part * bed.half;
  bed.line_to = bed.middle + settings.fitted_part * bed.half;
  std::vector<double> line_x, line_y, u, v;
  for (std::size_t i = 0; i < x.size(); ++i) {
    u.push_back((x[i] - bed.middle) / bed.half);
    v.push_back(y[i] / bed.half);
    if (x[i] < bed.line_from || x[i] > bed.line_to) continue;
    line_x.push_back(x[i]);
    line_y.push_back(y[i]);
  }
  bed.line = fit_line(line_x, line_y);
  bed.cubic = fit_cubic(u, v);
  bed.angle = std::atan(bed.line.parameters[1]);
  bed.middle_angle = std::atan(bed.cubic.parameters[1]);
  return bed;
}

BedContour bed_contour(const std::vector<Disc>& discs, double axis_x, double axis_y, double radius,
                       double rim, const BedContourSettings& settings) {
  Silhouette picture(window_of(discs, settings.pixel), settings.pixel);
  for (const Disc& disc : discs) picture.add(disc);
  return bed_contour(picture.upper_boundary(), axis_x, axis_y, radius, rim, settings);
}

}  // namespace seedflow
