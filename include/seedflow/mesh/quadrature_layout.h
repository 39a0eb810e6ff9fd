#pragma once

#include <deal.II/base/point.h>

#include <vector>

namespace seedflow {

/// Where the air keeps per-point data: the locally owned active cells are numbered 0..n_cells-1 in the
/// triangulation's traversal order, quadrature point q of cell c has index c * n_q + q.
/// Void fraction, drag coefficient and forces live at these points; so the same weights that average a field
/// at a sub-sphere, sum_q w_q u(x_q), deposit its force, f(x_q) = F w_q / JxW_q, and nothing is lost.
template <int dim>
struct QuadratureLayout {
  unsigned int n_cells = 0;
  unsigned int n_q = 0;
  std::vector<dealii::Point<dim>> position;  ///< [m], n_cells * n_q
  std::vector<double> JxW;          ///< quadrature weight times volume element [m^dim], n_cells * n_q
  std::vector<double> cell_volume;  ///< [m^dim], n_cells

  std::size_t size() const { return JxW.size(); }
};

}  // namespace seedflow
