#include <deal.II/base/mpi_remote_point_evaluation.h>
#include <deal.II/numerics/vector_tools_evaluate.h>

#include "fluid_state.h"

namespace seedflow {

template <int dim, int degree>
std::vector<typename Fluid<dim, degree>::Sample> Fluid<dim, degree>::sample(
    const std::vector<dealii::Point<dim>>& points) const {
  const auto& s = *implementation;
  // The first rank asks; the cells' owners answer.
  const bool asks = dealii::Utilities::MPI::this_mpi_process(s.domain.communicator()) == 0;
  dealii::Utilities::MPI::RemotePointEvaluation<dim> places(1e-6);
  places.reinit(asks ? points : std::vector<dealii::Point<dim>>(), s.domain.triangulation(),
                s.domain.mapping());
  std::vector<double> values;  // per point: inside, p, u
  const auto append = [&](const NodalVector& field, std::vector<std::vector<double>>& columns) {
    columns.push_back(dealii::VectorTools::point_values<1>(places, s.space->dofs, field));
  };
  s.fields.p.update_ghost_values();
  std::vector<std::vector<double>> columns;
  append(s.fields.p, columns);
  for (const NodalVector& u : s.fields.u) {
    u.update_ghost_values();
    append(u, columns);
  }
  if (asks)
    for (std::size_t i = 0; i < points.size(); ++i) {
      const bool inside = places.point_found(i);
      values.push_back(inside);
      for (const auto& column : columns) values.push_back(inside ? column[i] : 0.0);
    }
  values = dealii::Utilities::MPI::broadcast(s.domain.communicator(), values, 0);
  std::vector<Sample> result(points.size());
  auto next = values.begin();
  for (Sample& sample : result) {
    sample.inside = *next++ > 0;
    sample.pressure = *next++;
    for (int d = 0; d < dim; ++d) sample.velocity[d] = *next++;
  }
  return result;
}

template std::vector<Fluid<2, 1>::Sample> Fluid<2, 1>::sample(const std::vector<dealii::Point<2>>&) const;
template std::vector<Fluid<3, 1>::Sample> Fluid<3, 1>::sample(const std::vector<dealii::Point<3>>&) const;
template std::vector<Fluid<2, 2>::Sample> Fluid<2, 2>::sample(const std::vector<dealii::Point<2>>&) const;
template std::vector<Fluid<3, 2>::Sample> Fluid<3, 2>::sample(const std::vector<dealii::Point<3>>&) const;

}  // namespace seedflow
