#pragma once

#include <deal.II/grid/tria.h>

#include <map>
#include <string>

#include "seedflow/base/parameters.h"

namespace seedflow {

/// A round hole through a plate between two cylindrical chambers: section "Orifice".
struct OrificeGeometry {
  double diameter = 2e-3, length = 2e-3;                    ///< [m]
  double chamfer = 0;                                       ///< of the upstream edge, as wide as deep [m]
  double chamber_radius = 12e-3;                            ///< of both chambers [m]
  double upstream_depth = 12e-3, downstream_depth = 30e-3;  ///< of the chambers [m]
  bool quarter = true;  ///< only x > 0, y > 0: planes of symmetry, no asymmetric eddies

  int hole_sides = 4;          ///< cells along a quarter of the circumference, even
  int hole_rings = 2;          ///< rings between the core and the wall
  int hole_layers = 8;         ///< along the hole
  double growth = 1.3;         ///< from a cell to the next one away from the hole
  double largest_cell = 3e-3;  ///< [m]

  void declare(Parameters& parameters);
  void check(const Parameters& parameters) const;
};

/// Its mesh: the axis is z, the plate's upstream face z = 0; the flow goes towards +z.
/// Sides: upstream, downstream (the far ends), chamber (cylindrical walls), plate (both faces), hole,
/// symmetry (of the quarter).
struct OrificeMesh {
  dealii::Triangulation<3> coarse;
  std::map<dealii::types::boundary_id, std::string> sides;

  explicit OrificeMesh(const OrificeGeometry& geometry);
};

}  // namespace seedflow
