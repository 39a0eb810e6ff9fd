#include "seedflow/coupling/solid_seeds.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace seedflow {

bool SolidSeeds::covers(const Vec3& x) const {
  return std::any_of(places.begin(), places.end(),
                     [&](const Vec3& place) { return norm_square(x - place) < reach * reach; });
}

void SolidSeeds::mark(const Dem& dem, double ahead) {
  points.clear();
  forces.assign(dem.n_seeds(), Vec3());
  std::vector<Vec3> near;
  const double c = std::cos(lag), w = std::sin(lag);
  for (int seed = 0; seed < dem.n_seeds(); ++seed) {
    const SeedState state = dem.seed_state(seed);
    const Vec3 centre = state.centre + ahead * state.velocity;
    const double radius = 0.5 * dem.seed_template(seed).equivalent_diameter, widest = 1.25 * radius;
    near.clear();
    for (const Vec3& place : places)
      if (norm_square(centre - place) < (reach + widest) * (reach + widest)) near.push_back(place);
    if (near.empty()) continue;
    location.cells_in_box(
        {centre.x - widest, centre.y - widest, centre.z - widest},
        {centre.x + widest, centre.y + widest, centre.z + widest}, [&](int cell) {
          const double grown = std::min(widest, radius + margin * std::cbrt(layout.cell_volume[cell]));
          const std::uint32_t first = cell * layout.n_q;
          for (std::uint32_t q = first; q < first + layout.n_q; ++q) {
            const auto& p = layout.position[q];
            const Vec3 x{c * p[0] - w * p[1], w * p[0] + c * p[1], p[2]}, arm = x - centre;
            const double square = norm_square(arm);
            if (square >= grown * grown) continue;
            if (std::none_of(near.begin(), near.end(),
                             [&](const Vec3& place) { return norm_square(x - place) < reach * reach; }))
              continue;
            points.push_back({q, seed, square, state.velocity + cross(state.spin, arm)});
          }
        });
  }
  // A point that two grown balls share belongs to the nearer one.
  std::sort(points.begin(), points.end(), [](const Marked& a, const Marked& b) {
    return std::tie(a.q, a.square, a.seed) < std::tie(b.q, b.square, b.seed);
  });
  points.erase(
      std::unique(points.begin(), points.end(), [](const Marked& a, const Marked& b) { return a.q == b.q; }),
      points.end());
}

void SolidSeeds::deposit(Exchange<3>& exchange) const {
  for (const Marked& p : points) {
    exchange.drag_coefficient[p.q] += beta;
    for (int d = 0; d < 3; ++d) exchange.drag_source[p.q][d] += beta * p.velocity[d];
  }
}

void SolidSeeds::collect(const std::vector<dealii::Tensor<1, 3>>& velocity) {
  for (const Marked& p : points) {
    const auto& u = velocity[p.q];
    forces[p.seed] += beta * layout.JxW[p.q] * (Vec3{u[0], u[1], u[2]} - p.velocity);
  }
  if (!forces.empty())
    MPI_Allreduce(MPI_IN_PLACE, forces.data(), static_cast<int>(3 * forces.size()), MPI_DOUBLE, MPI_SUM,
                  comm);
}

}  // namespace seedflow
