#include "seedflow/mesh/point_location_bench.h"

#include <deal.II/base/timer.h>
#include <deal.II/distributed/tria.h>
#include <deal.II/grid/grid_generator.h>

#include <algorithm>
#include <random>

#include "seedflow/mesh/point_location.h"

namespace seedflow {

using dealii::Point;

PointLocationRate measure_point_location(MPI_Comm communicator) {
  dealii::parallel::distributed::Triangulation<3> triangulation(communicator);
  const Point<3> lower, upper(0.1, 0.1, 0.12);
  dealii::GridGenerator::subdivided_hyper_rectangle(triangulation, {20, 20, 24}, lower, upper);
  while (triangulation.n_global_active_cells() < 45000) {
    // The finest cells gather around the middle, as they do around a disc's holes.
    const double radius = 0.042 / triangulation.n_levels();
    for (const auto& cell : triangulation.active_cell_iterators())
      if (cell->is_locally_owned() && cell->center().distance(Point<3>(0.05, 0.05, 0.06)) < radius)
        cell->set_refine_flag();
    triangulation.execute_coarsening_and_refinement();
  }

  const int n_seeds = 800, n_sub_spheres = 70, repeats = 21;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<Point<3>> points;
  for (int s = 0; s < n_seeds; ++s) {
    const Point<3> centre(0.02 + 0.06 * uniform(random), 0.02 + 0.06 * uniform(random),
                          0.02 + 0.08 * uniform(random));
    for (int i = 0; i < n_sub_spheres; ++i)
      points.push_back(centre +
                       0.004 * Point<3>(uniform(random) - 0.5, uniform(random) - 0.5, uniform(random) - 0.5));
  }

  PointLocationRate result;
  result.n_cells = triangulation.n_global_active_cells();
  result.n_points = points.size();
  PointLocation<3> location;
  dealii::Timer timer;
  location.build(triangulation, lower, upper, {{20, 20, 24}});
  result.build_ms = 1e3 * timer.wall_time();

  std::vector<double> times;
  std::vector<int> cell(points.size());
  for (int r = 0; r < repeats; ++r) {
    timer.restart();
    for (std::size_t p = 0; p < points.size(); ++p) cell[p] = location.cell_of(points[p]);
    times.push_back(1e3 * timer.wall_time());
    for (Point<3>& p : points) p[2] += 1e-6;  // another step
  }
  std::nth_element(times.begin(), times.begin() + repeats / 2, times.end());
  result.look_up_ms = times[repeats / 2];
  return result;
}

}  // namespace seedflow
