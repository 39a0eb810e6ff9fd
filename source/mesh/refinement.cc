#include "seedflow/mesh/refinement.h"

#include <deal.II/grid/grid_tools.h>

#include <algorithm>
#include <cmath>

namespace seedflow {

namespace {

/// The largest criterion of each owned cell relative to its threshold, by the void fraction: within the cell,
/// and between its mean and those of its neighbours.
template <int dim>
std::vector<double> void_fraction_contrast(const Domain<dim>& domain, const QuadratureLayout<dim>& layout,
                                           const std::vector<double>& eps) {
  const auto& mesh = domain.triangulation();
  std::vector<double> mean(mesh.n_active_cells(), 0.0), contrast(layout.n_cells, 0.0);
  std::size_t c = 0;
  for (const auto& cell : mesh.active_cell_iterators()) {
    if (!cell->is_locally_owned()) continue;
    const auto begin = eps.begin() + c * layout.n_q, end = begin + layout.n_q;
    const auto range = std::minmax_element(begin, end);
    contrast[c] = *range.second - *range.first;
    for (unsigned int q = 0; q < layout.n_q; ++q)
      mean[cell->active_cell_index()] += begin[q] * layout.JxW[c * layout.n_q + q] / layout.cell_volume[c];
    ++c;
  }
  using Cell = typename Domain<dim>::Triangulation::active_cell_iterator;
  dealii::GridTools::exchange_cell_data_to_ghosts<double>(
      mesh,
      [&](const Cell& cell) { return dealii::std_cxx17::optional<double>(mean[cell->active_cell_index()]); },
      [&](const Cell& cell, const double& value) { mean[cell->active_cell_index()] = value; });
  c = 0;
  for (const auto& cell : mesh.active_cell_iterators()) {
    if (!cell->is_locally_owned()) continue;
    const double own = mean[cell->active_cell_index()];
    const auto compare = [&](const auto& neighbour) {
      contrast[c] = std::max(contrast[c], std::abs(mean[neighbour->active_cell_index()] - own));
    };
    for (const unsigned int f : cell->face_indices()) {
      if (cell->at_boundary(f)) continue;
      const auto neighbour = cell->neighbor(f);
      if (neighbour->is_active())
        compare(neighbour);
      else
        for (unsigned int s = 0; s < cell->face(f)->n_children(); ++s)
          compare(cell->neighbor_child_on_subface(f, s));
    }
    ++c;
  }
  return contrast;
}

/// Distance from a point to the box around a cell.
template <int dim>
double distance(const dealii::Point<dim>& x, const dealii::BoundingBox<dim>& box) {
  double square = 0;
  for (int d = 0; d < dim; ++d) {
    const double outside = std::max(
        {0.0, box.get_boundary_points().first[d] - x[d], x[d] - box.get_boundary_points().second[d]});
    square += outside * outside;
  }
  return std::sqrt(square);
}

}  // namespace

void RefinementParameters::declare(Parameters& p) {
  const auto section =
      p.section("Adaptive refinement", "Where and when the air mesh is refined during the run.");
  p.integer("Interval", interval, Range::between(0, 1000000), "Air steps between two adaptations; 0: never.");
  p.integer("Lowest level", min_level, Range::between(0, 12), "Refinements every cell has at least.");
  p.integer("Highest level", max_level, Range::between(0, 12), "Refinements a cell has at most.");
  p.number("Void fraction jump", void_fraction_jump, "1", Range::between(0, 1),
           "Cells with a larger difference of void fraction within them or to a neighbour are refined; 0: "
           "not used.");
  p.number("Velocity jump", velocity_jump, "m/s", Range::non_negative(),
           "Cells with a larger difference of velocity within them are refined; 0: not used.");
  p.number("Seed distance", seed_distance, "m", Range::non_negative(),
           "Cells nearer than this to a seed are refined; 0: not used.");
  p.number("Hole distance", hole_distance, "m", Range::non_negative(),
           "Cells nearer than this to the axis of a device's hole that faces the vacuum are refined; 0: not "
           "used.");
}

template <int dim>
bool flag_cells(const RefinementParameters& p, Domain<dim>& domain, const QuadratureLayout<dim>& layout,
                const std::vector<double>& void_fraction, const std::vector<double>& velocity_jump,
                const std::vector<dealii::Point<dim>>& seeds, const std::vector<dealii::Point<dim>>& holes) {
  if (p.min_level > p.max_level)
    throw InputError("Adaptive refinement: Lowest level " + std::to_string(p.min_level) +
                     " is above Highest level " + std::to_string(p.max_level) + ". Exchange them.");
  if ((!void_fraction.empty() && void_fraction.size() != layout.size()) ||
      (!velocity_jump.empty() && velocity_jump.size() != layout.n_cells))
    throw RunError(
        "Adaptive refinement: the fields given do not belong to the present mesh; use Fluid::layout().");
  const bool by_eps = p.void_fraction_jump > 0 && !void_fraction.empty();
  const bool by_velocity = p.velocity_jump > 0 && !velocity_jump.empty();
  const bool by_seeds = p.seed_distance > 0, by_holes = p.hole_distance > 0;
  const std::vector<double> contrast =
      by_eps ? void_fraction_contrast(domain, layout, void_fraction) : std::vector<double>();
  double flagged = 0;
  std::size_t c = 0;
  for (const auto& cell : domain.triangulation().active_cell_iterators()) {
    if (!cell->is_locally_owned()) continue;
    cell->clear_refine_flag();
    cell->clear_coarsen_flag();
    bool refine = cell->level() < p.min_level, coarsen = by_eps || by_velocity || by_seeds || by_holes;
    const auto judge = [&](double value, double threshold) {
      refine = refine || value > threshold;
      coarsen = coarsen && value < 0.5 * threshold;
    };
    if (by_eps) judge(contrast[c], p.void_fraction_jump);
    if (by_velocity) judge(velocity_jump[c], p.velocity_jump);
    const auto keep_fine_near = [&](const std::vector<dealii::Point<dim>>& places, double reach) {
      double nearest = 1e300;
      const auto box = cell->bounding_box();
      for (const auto& x : places) nearest = std::min(nearest, distance(x, box));
      refine = refine || nearest < reach;
      coarsen = coarsen && nearest > 2 * reach;
    };
    if (by_seeds) keep_fine_near(seeds, p.seed_distance);
    if (by_holes) keep_fine_near(holes, p.hole_distance);
    if ((refine && cell->level() < p.max_level)) {
      cell->set_refine_flag();
      ++flagged;
    } else if ((!refine && coarsen && cell->level() > p.min_level) || cell->level() > p.max_level) {
      cell->set_coarsen_flag();
      ++flagged;
    }
    ++c;
  }
  return dealii::Utilities::MPI::sum(flagged, domain.communicator()) > 0;
}

template bool flag_cells(const RefinementParameters&, Domain<2>&, const QuadratureLayout<2>&,
                         const std::vector<double>&, const std::vector<double>&,
                         const std::vector<dealii::Point<2>>&, const std::vector<dealii::Point<2>>&);
template bool flag_cells(const RefinementParameters&, Domain<3>&, const QuadratureLayout<3>&,
                         const std::vector<double>&, const std::vector<double>&,
                         const std::vector<dealii::Point<3>>&, const std::vector<dealii::Point<3>>&);

}  // namespace seedflow
