#pragma once

#include <vector>

#include "seedflow/mesh/domain.h"
#include "seedflow/mesh/quadrature_layout.h"

namespace seedflow {

/// Where the air mesh shall be fine: section "Air domain/Adaptive refinement". A threshold of 0 switches its
/// criterion off; without any criterion the mesh stays as it is.
struct RefinementParameters {
  int interval = 0;                  ///< air steps between adaptations; 0 = never
  int min_level = 0, max_level = 3;  ///< refinements of the coarse mesh a cell may have
  double void_fraction_jump = 0;     ///< largest difference of eps within a cell and to its neighbours' means
  double velocity_jump = 0;          ///< largest difference of velocity within a cell [m/s]
  double seed_distance = 0;          ///< cells nearer than this to a seed are fine [m]
  double hole_distance = 0;          ///< cells nearer than this to a hole that sucks are fine [m]

  /// Inside a section that the caller has opened.
  void declare(Parameters& parameters);
};

/// Flags the locally owned cells for refinement where a criterion is above its threshold, and for coarsening
/// where all are below half of it (seeds and holes: beyond twice the distance), within the levels allowed.
/// The mesh itself keeps neighbours within one level when it is adapted (Fluid::refine). Collective; the
/// flags do not depend on the number of ranks. Returns whether any cell of any rank is flagged.
///   void_fraction  per point of `layout`; empty = not used
///   velocity_jump  per cell of `layout` [m/s]; empty = not used
///   seeds          positions of all seeds [m], the same on all ranks
///   holes          the same of holes that suck, see DeviceGeometry::sucking_holes
/// Errors: InputError if min_level > max_level; RunError if an array does not fit the layout.
template <int dim>
bool flag_cells(const RefinementParameters& parameters, Domain<dim>& domain,
                const QuadratureLayout<dim>& layout, const std::vector<double>& void_fraction,
                const std::vector<double>& velocity_jump, const std::vector<dealii::Point<dim>>& seeds,
                const std::vector<dealii::Point<dim>>& holes = {});

}  // namespace seedflow
