#pragma once

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/distributed/tria.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/grid/grid_generator.h>

#include "seedflow/mesh/point_location.h"
#include "seedflow/mesh/quadrature_layout.h"

namespace seedflow {

/// A box of 30 x 30 x 60 mm in cells of 3 mm, refined once around its centre, with its quadrature points.
struct RefinedBox {
  dealii::parallel::distributed::Triangulation<3> triangulation{MPI_COMM_WORLD};
  PointLocation<3> location;
  QuadratureLayout<3> layout;

  RefinedBox() {
    const dealii::Point<3> lower, upper(0.03, 0.03, 0.06);
    dealii::GridGenerator::subdivided_hyper_rectangle(triangulation, {10, 10, 20}, lower, upper);
    for (const auto& cell : triangulation.active_cell_iterators())
      if (cell->is_locally_owned() && cell->center().distance(dealii::Point<3>(0.015, 0.015, 0.03)) < 0.008)
        cell->set_refine_flag();
    triangulation.execute_coarsening_and_refinement();
    location.build(triangulation, lower, upper, {{10, 10, 20}});

    const dealii::QGauss<3> quadrature(2);
    const dealii::FE_Q<3> fe(1);
    dealii::FEValues<3> values(fe, quadrature, dealii::update_JxW_values | dealii::update_quadrature_points);
    layout.n_q = quadrature.size();
    for (const auto& cell : triangulation.active_cell_iterators())
      if (cell->is_locally_owned()) {
        values.reinit(cell);
        ++layout.n_cells;
        layout.cell_volume.push_back(cell->measure());
        for (unsigned int q = 0; q < layout.n_q; ++q) {
          layout.position.push_back(values.quadrature_point(q));
          layout.JxW.push_back(values.JxW(q));
        }
      }
  }
};

}  // namespace seedflow
