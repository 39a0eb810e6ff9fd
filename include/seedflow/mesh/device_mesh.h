#pragma once

#include <deal.II/grid/tria.h>

#include <map>
#include <string>

#include "seedflow/base/device_geometry.h"
#include "seedflow/base/parameters.h"
#include "seedflow/mesh/domain.h"

namespace seedflow {

/// How fine the air mesh of a seed-metering device is before refinement: section "Device mesh".
struct DeviceMeshParameters {
  int hole_sides = 4;          ///< cells along a quarter of a hole's circumference
  int hole_rings = 2;          ///< rings of cells between a hole's core and its wall
  int mouth_rings = 3;         ///< rings around a hole's mouth on the disc
  int hole_layers = 4;         ///< along the straight part of a hole
  int chamfer_layers = 1;      ///< along the chamfer
  double face_cell = 0.3e-3;   ///< first layer in front of the disc [m]
  double vacuum_cell = 1e-3;   ///< in the vacuum chamber along the holes' path and behind the disc [m]
  double largest_cell = 4e-3;  ///< anywhere [m]
  double growth = 1.5;         ///< from a cell to the next one away from the holes

  void declare(Parameters& parameters);
};

/// Air in a seed-metering device, as two separate coarse meshes in one triangulation:
///   material `turning`   the seed chamber and the holes, which turn with the disc. The seed chamber is a
///   body
///                        of revolution, so its housing slides along itself.
///   material `standing`  the vacuum chamber
/// They touch in the plane of the disc's back face, where the holes' ends slide over the chamber.
/// Sides: of the turning part
///   ambient      the seed chamber's open front
///   housing      its inner and outer wall, at rest
///   disc, hole   the disc's front face and the walls of the holes; turn
///   hole end     sliding interface
/// and of the standing part
///   vacuum face  sliding interface; where no hole is, the disc's back
///   suction      the back of the chamber, where the air leaves
///   vacuum wall  the other walls
/// Coordinates as in DeviceGeometry, disc not turned. Hole k has boundary and manifold ids like any other: it
/// is known by its place.
struct DeviceMesh {
  static constexpr dealii::types::material_id standing = 0, turning = 1;
  dealii::Triangulation<3> coarse;
  std::map<dealii::types::boundary_id, std::string> sides;

  DeviceMesh(const DeviceGeometry& geometry, const DeviceMeshParameters& parameters);
};

/// The domain with that mesh and its rotor.
Domain<3> device_domain(const DeviceGeometry& geometry, const DeviceMeshParameters& parameters,
                        MPI_Comm comm);

}  // namespace seedflow
