#include "seedflow/coupling/covered_hole.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace seedflow {

CoveredHole::CoveredHole(double hole_radius, double chamfer, double seed_radius)
    : radius(hole_radius),
      seat_radius(std::clamp(seed_radius * std::sqrt(0.5), hole_radius, hole_radius + chamfer)),
      seat_depth(hole_radius + chamfer - seat_radius) {}

CoveredHole::Outcome CoveredHole::evaluate(const std::vector<Ball>& balls, double exposure) const {
  Outcome result;
  const double hole = hole_coefficient * exposure * M_PI * radius * radius;
  result.area.assign(balls.size(), Vec3());
  result.flow_area = hole;
  if (hole <= 0 || balls.empty()) return result;

  using Ring = std::array<Vec3, rim_points>;
  static const Ring direction = [] {
    Ring ring;
    for (int i = 0; i < rim_points; ++i)
      ring[i] = {std::cos(2 * M_PI * i / rim_points), std::sin(2 * M_PI * i / rim_points), 0};
    return ring;
  }();
  std::vector<Ring> foot(balls.size());
  std::vector<std::array<double, rim_points>> share(balls.size());
  std::array<double, rim_points> sum{};
  for (std::size_t k = 0; k < balls.size(); ++k)
    for (int i = 0; i < rim_points; ++i) {
      const Vec3 rim = seat_radius * direction[i] - Vec3{0, 0, seat_depth};
      const Vec3 away = rim - balls[k].centre;
      const double distance = norm(away), gap = std::max(distance - balls[k].radius, roughness);
      // A ball that reaches over the rim (a clump that sits deeper than a ball could) is sealed off at it.
      foot[k][i] = balls[k].centre + std::min(1.0, balls[k].radius / distance) * away;
      share[k][i] = 1 / (gap * gap * gap * gap);
      sum[i] += share[k][i];
    }
  double curtain = 0;
  for (int i = 0; i < rim_points; ++i)
    curtain += 2 * M_PI * seat_radius / rim_points / std::sqrt(std::sqrt(sum[i]));
  result.gap_area = curtain;
  const double gaps = gap_coefficient * curtain;
  result.cover = hole * hole / (hole * hole + gaps * gaps);
  result.flow_area = hole * gaps / std::hypot(hole, gaps);

  for (std::size_t k = 0; k < balls.size(); ++k) {
    const Ball& ball = balls[k];
    const double distance = norm(ball.centre);
    const Vec3 middle = distance > 0 ? ball.centre - (ball.radius / distance) * ball.centre : Vec3();
    for (int i = 0; i < rim_points; ++i) {
      const int j = (i + 1) % rim_points;
      const double carried = 0.5 * (share[k][i] / sum[i] + share[k][j] / sum[j]);
      result.area[k] -= 0.5 * carried * cross(foot[k][i] - middle, foot[k][j] - middle);
    }
  }
  return result;
}

}  // namespace seedflow
