#include <gtest/gtest.h>

#include "../mesh/rotor_mesh.h"
#include "seedflow/fluid/krylov.h"
#include "seedflow/fluid/sliding_coupling.h"

// Poisson's equation across the sliding interface, by the operators the air uses.

namespace seedflow {
namespace {

const double angles[] = {0, 0.1, 0.777, 2.5};

/// int grad q_i . grad q_j within the cells.
template <int dim, int degree>
void assemble_cells(const NodalSpace<dim, degree>& space, SparseMatrix& matrix) {
  constexpr int n = NodalSpace<dim, degree>::n, n_q = NodalSpace<dim, degree>::n_q;
  matrix.set_zero();
  for (std::size_t group = 0; group < space.n_groups; ++group) {
    Lanes local[n * n] = {};
    for (int q = 0; q < n_q; ++q) {
      Lanes g[n][dim];
      const Lanes* j = space.inverse_jacobian(group, q);
      for (int i = 0; i < n; ++i)
        for (int d = 0; d < dim; ++d) {
          g[i][d] = broadcast(0.0);
          for (int e = 0; e < dim; ++e) g[i][d] += space.shape.test[q][1 + e][i] * j[e * dim + d];
        }
      for (int a = 0; a < n; ++a)
        for (int b = 0; b < n; ++b)
          for (int d = 0; d < dim; ++d) local[a * n + b] += space.weight(group, q) * g[a][d] * g[b][d];
    }
    space.scatter(local, group, matrix);
  }
  matrix.compress();
}

struct Outcome {
  double error;  ///< largest at a node
  int iterations;
};

/// -laplace p = f with p given on all sides but the sliding ones, the rotor at `angle`.
template <int dim, int degree>
Outcome solve(Domain<dim>& domain, double angle,
              const std::function<double(const dealii::Point<dim>&)>& exact,
              const std::function<double(const dealii::Point<dim>&)>& source) {
  domain.turn_to(0);
  NodalSpace<dim, degree> space(domain);
  SlidingCoupling<dim, degree> coupling(space, domain);
  domain.turn_to(angle);
  space.turn_to(*domain.rotor(), angle);
  coupling.turn_to(angle);
  SparseMatrix matrix(space.structure);
  assemble_cells(space, matrix);
  matrix.set_patch(coupling.patch());
  coupling.add_diffusion(coupling.share(1, [](std::size_t, int, int) { return 1.0; }), false, matrix);

  const auto& partitioner = *space.structure->partitioner;
  NodalVector p, b, flag;
  for (auto* v : {&p, &b, &flag}) space.initialize(*v);
  std::vector<double> truth(space.constrained.size(), NAN);
  std::vector<dealii::types::global_dof_index> ids(space.n);
  for (const auto& cell : space.dofs.active_cell_iterators()) {
    if (!cell->is_locally_owned()) continue;
    cell->get_dof_indices(ids);
    for (int i = 0; i < space.n; ++i)
      truth[partitioner.global_to_local(ids[i])] =
          exact(domain.mapping().transform_unit_to_real_cell(cell, space.fe.get_unit_support_points()[i]));
    for (const unsigned int f : cell->face_indices())
      if (cell->face(f)->at_boundary() && !domain.is_sliding(domain.sides().at(cell->face(f)->boundary_id())))
        for (int i = 0; i < space.n; ++i)
          if (space.fe.has_support_on_face(i, f)) flag(ids[i]) = 1;
  }
  flag.compress(dealii::VectorOperation::add);
  flag.update_ghost_values();
  std::vector<char> fixed(space.constrained.size());
  for (std::size_t i = 0; i < fixed.size(); ++i) fixed[i] = flag.local_element(i) > 0 || space.constrained[i];
  for (std::uint32_t i = 0; i < space.structure->n_owned(); ++i)
    if (flag.local_element(i) > 0) p.local_element(i) = truth[i];
  for (std::size_t group = 0; group < space.n_groups; ++group) {
    Lanes r[NodalSpace<dim, degree>::n] = {};
    for (int q = 0; q < space.n_q; ++q) {
      Lanes f{};
      for (int l = 0; l < space.W; ++l)
        f[l] = source(space.layout.position[space.cell[group * space.W + l] * space.n_q + q]);
      for (int i = 0; i < space.n; ++i) r[i] += space.weight(group, q) * f * space.shape.test[q][0][i];
    }
    space.scatter(r, group, b);
  }
  b.compress(dealii::VectorOperation::add);
  const auto preconditioner = make_multigrid("trilinos");
  preconditioner->build(matrix, fixed, false);
  Outcome result{0, conjugate_gradients(matrix, *preconditioner, fixed, false, p, b, 1e-12, 500)};
  EXPECT_GE(result.iterations, 0);
  for (std::uint32_t i = 0; i < space.structure->n_owned(); ++i)
    if (!space.constrained[i]) result.error = std::max(result.error, std::abs(p.local_element(i) - truth[i]));
  result.error = dealii::Utilities::MPI::max(result.error, domain.communicator());
  domain.turn_to(0);
  return result;
}

double wave(const dealii::Point<2>& x) {
  return std::sin(3 * x[0] + 0.5) * std::cos(2 * x[1]);
}
double wave_source(const dealii::Point<2>& x) {
  return 13 * wave(x);
}

TEST(SlidingPoissonMpi, RingOrderTwoAtAnyAngle) {
  for (const double angle : angles) {
    double before = 0;
    for (int refinements : {1, 2, 3}) {
      const auto domain = ring(0.4, 0.7, 1, 9, 14, 2, refinements);
      const Outcome o = solve<2, 1>(*domain, angle, wave, wave_source);
      if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
        std::cout << angle << " " << refinements << " " << o.error << " its " << o.iterations << "\n";
      if (before > 0) {
        EXPECT_LT(o.error, before / 3) << angle;
      }
      before = o.error;
    }
  }
}

/// A linear field has no jump, so a plane interface must not disturb it at all, with general quadrilaterals
/// and hanging nodes there. At general angles corners of the square have no partner, where nothing may flow:
/// the field is then one along the plane.
TEST(SlidingPoissonMpi, PlaneLinearFieldIsExact) {
  const auto domain = blocks(1, 3, 1, 4, 0.1);
  for (const auto& cell : domain->triangulation().active_cell_iterators())
    if (cell->is_locally_owned() && cell->center()[0] + 0.3 * cell->center()[1] > 0.2)
      cell->set_refine_flag();
  domain->triangulation().execute_coarsening_and_refinement();
  for (const double angle : {0.0, 0.1, 0.777, dealii::numbers::PI / 2, 2.5}) {
    const double across = std::abs(std::sin(2 * angle)) < 1e-12 ? 3 : 0;
    const Outcome o = solve<3, 1>(
        *domain, angle, [&](const auto& x) { return 1 + x[0] - 2 * x[1] + across * x[2]; },
        [](const auto&) { return 0.0; });
    EXPECT_LT(o.error, 1e-11) << angle;
  }
}

/// In space: a field that is smooth across a cylinder.
TEST(SlidingPoissonMpi, CylinderOrderTwoAtAnyAngle) {
  const auto exact = [](const dealii::Point<3>& x) {
    return std::sin(2 * x[0] + 0.3) * std::cos(x[1]) * std::cos(2 * x[2] + 0.2);
  };
  for (const double angle : {0.1, 2.5}) {
    double before = 0;
    for (const int refinements : {0, 1, 2}) {
      const auto domain = tube(0.4, 0.7, 1, 16, 24, refinements);
      const Outcome o =
          solve<3, 1>(*domain, angle, exact, [&](const dealii::Point<3>& x) { return 9 * exact(x); });
      if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
        std::cout << "cylinder " << angle << " " << refinements << " " << o.error << " its " << o.iterations
                  << "\n";
      if (before > 0) {
        EXPECT_LT(o.error, before / 2.8) << angle;
      }
      before = o.error;
    }
  }
}

/// In space: a field that is smooth across a plane, nothing flowing through the uncovered corners.
TEST(SlidingPoissonMpi, PlaneOrderTwoAtAnyAngle) {
  const auto exact = [](const dealii::Point<3>& x) {
    return std::sin(2 * x[0] + 0.3) * std::cos(x[1]) * std::cos(2 * x[2]);
  };
  for (const double angle : {0.0, 0.777}) {
    double before = 0;
    for (const int refinements : {1, 2, 3}) {
      const auto domain = blocks(1, 2, 1, 3, 0.1);
      domain->triangulation().refine_global(refinements);
      const Outcome o =
          solve<3, 1>(*domain, angle, exact, [&](const dealii::Point<3>& x) { return 9 * exact(x); });
      if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
        std::cout << "plane " << angle << " " << refinements << " " << o.error << " its " << o.iterations
                  << "\n";
      if (before > 0) {
        EXPECT_LT(o.error, before / 3) << angle;
      }
      before = o.error;
    }
  }
}

}  // namespace
}  // namespace seedflow
