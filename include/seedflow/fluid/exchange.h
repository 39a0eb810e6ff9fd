#pragma once

#include <deal.II/base/tensor.h>

#include <vector>

namespace seedflow {

/// What the seeds do to the air during one step, at every quadrature point of QuadratureLayout.
/// The volumetric force on the air is  drag_source - drag_coefficient * u + force,  u implicit.
template <int dim>
struct Exchange {
  std::vector<double> void_fraction;                    ///< eps at the end of the step
  std::vector<double> drag_coefficient;                 ///< beta = sum_p k_p w_pq / JxW_q [kg/(m3 s)]
  std::vector<dealii::Tensor<1, dim>> drag_source;      ///< sum_p k_p v_p w_pq / JxW_q [N/m3]
  std::vector<dealii::Tensor<1, dim>> force;            ///< explicit part [N/m3]

  void clear(std::size_t n_points) {
    void_fraction.assign(n_points, 1.0);
    drag_coefficient.assign(n_points, 0.0);
    drag_source.assign(n_points, dealii::Tensor<1, dim>());
    force.assign(n_points, dealii::Tensor<1, dim>());
  }
};

}  // namespace seedflow
