#include "seedflow/mesh/point_location_bench.h"

#include <deal.II/base/timer.h>
#include <deal.II/distributed/tria.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "seedflow/mesh/point_location.h"

namespace seedflow {

using dealii::Point;

namespace {

const Point<3> lower, upper(0.1, 0.1, 0.12);

/// The finest cells gather around the middle, as they do around a disc's holes.
void refine(dealii::parallel::distributed::Triangulation<3>& triangulation) {
  while (triangulation.n_global_active_cells() < 45000) {
    const double radius = 0.042 / triangulation.n_levels();
    for (const auto& cell : triangulation.active_cell_iterators())
      if (cell->is_locally_owned() && cell->center().distance(Point<3>(0.05, 0.05, 0.06)) < radius)
        cell->set_refine_flag();
    triangulation.execute_coarsening_and_refinement();
  }
}

std::vector<Point<3>> points_of_seeds() {
  const int n_seeds = 800, n_sub_spheres = 70;
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
  return points;
}

/// Median time of a look-up of all points, each with its cell of the step before as first guess [ms].
double look_up(const PointLocation<3>& location, std::vector<Point<3>> points) {
  const int repeats = 21;
  std::vector<double> times;
  std::vector<int> cell;
  for (const Point<3>& p : points) cell.push_back(location.cell_of(p));
  dealii::Timer timer;
  for (int r = 0; r < repeats; ++r) {
    timer.restart();
    for (std::size_t p = 0; p < points.size(); ++p) cell[p] = location.cell_of(points[p], cell[p]);
    times.push_back(1e3 * timer.wall_time());
    for (Point<3>& p : points) p[2] += 1e-6;  // another step
  }
  std::nth_element(times.begin(), times.begin() + repeats / 2, times.end());
  return times[repeats / 2];
}

}  // namespace

PointLocationRate measure_point_location(MPI_Comm communicator) {
  PointLocationRate result;
  const std::vector<Point<3>> points = points_of_seeds();
  result.n_points = points.size();
  dealii::Triangulation<3> coarse;
  dealii::GridGenerator::subdivided_hyper_rectangle(coarse, {20, 20, 24}, lower, upper);
  PointLocation<3> location;
  {
    dealii::parallel::distributed::Triangulation<3> triangulation(communicator);
    triangulation.copy_triangulation(coarse);
    refine(triangulation);
    result.n_cells = triangulation.n_global_active_cells();
    const dealii::Timer timer;
    location.build(triangulation, lower, upper, {{20, 20, 24}});
    result.build_ms = 1e3 * timer.wall_time();
    result.look_up_ms = look_up(location, points);
  }
  dealii::GridTools::transform(
      [](const Point<3>& x) {  // a third of a cell, so that no two faces are parallel
        return x + 0.0015 * Point<3>(std::sin(300 * x[1]), std::sin(250 * x[2]), std::sin(200 * x[0] * x[1]));
      },
      coarse);
  Domain<3> domain(coarse, {{0, "all"}}, {}, communicator);
  refine(domain.triangulation());
  dealii::Timer timer;
  location.build(domain);
  result.hexahedra_build_ms = 1e3 * timer.wall_time();
  timer.restart();
  for (const Point<3>& p : points) location.cell_of(p);
  result.hexahedra_first_ms = 1e3 * timer.wall_time();
  result.hexahedra_look_up_ms = look_up(location, points);
  return result;
}

}  // namespace seedflow
