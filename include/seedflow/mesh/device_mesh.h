#pragma once

#include <deal.II/grid/tria.h>

#include <iosfwd>
#include <map>
#include <string>

#include "seedflow/base/device_geometry.h"
#include "seedflow/base/parameters.h"
#include "seedflow/mesh/domain.h"
#include "seedflow/mesh/hole_plane.h"

namespace seedflow {

/// The air mesh of a seed-metering device: how fine it is before refinement, or the file it is in; section
/// "Device mesh".
struct DeviceMeshParameters {
  std::string file;            ///< of a mesh made elsewhere, see read_device_mesh(); "": made here
  double unit = 1e-3;          ///< what 1 means in the file [m]
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
  enum Side : dealii::types::boundary_id {
    ambient,
    housing,
    disc,
    hole,
    hole_end,
    vacuum_face,
    suction,
    vacuum_wall
  };
  static const std::map<dealii::types::boundary_id, std::string>& side_names();
  static const std::map<dealii::types::material_id, std::string>& part_names();
  static bool turns(Side side) { return side <= hole_end; }

  dealii::Triangulation<3> coarse;
  std::map<dealii::types::boundary_id, std::string> sides = side_names();

  /// Made from the geometry, or read and checked if the parameters name a file.
  DeviceMesh(const DeviceGeometry& geometry, const DeviceMeshParameters& parameters);
  /// Least depth of the cells at the disc's front face [m].
  double face_cell() const;
};

/// Reads the mesh of somebody's own device from an ASCII Gmsh file of hexahedra: the physical volumes
/// `turning` and `standing` and the sides above as physical surfaces, of which `housing` and `vacuum wall`
/// may be absent. What the file says is held against the geometry, which the seeds see: holes end at the back
/// of the disc, each where it is declared and as wide (area within 15 %); the vacuum face lies under every
/// hole that the vacuum's arc covers whole, and under none outside; the disc's front face is z = 0 around the
/// holes; what turns with the mesh but stands in truth (housing, ambient) is a body of revolution.
///
/// Errors: InputError naming the file, what is wanted and what was found, and the remedy.
void read_device_mesh(const std::string& file, double unit, const DeviceGeometry& geometry,
                      dealii::Triangulation<3>& coarse);

/// The domain with that mesh and its rotor.
Domain<3> device_domain(const DeviceGeometry& geometry, const DeviceMeshParameters& parameters,
                        MPI_Comm comm);

/// Everything that can be wrong with the mesh, also what shows only when rotor and stator are joined.
/// Collective. Errors: InputError.
void check_device_mesh(const DeviceGeometry& geometry, const DeviceMeshParameters& parameters, MPI_Comm comm);

/// Writes the mesh as a Gmsh file that read_device_mesh() reads, in this unit [m].
void write_device_mesh(const DeviceMesh& mesh, double unit, std::ostream& out);

/// The seed chamber's cross section with its holes, of quadrilaterals.
HolePlane seed_chamber_plane(const DeviceGeometry& geometry, const DeviceMeshParameters& parameters);

}  // namespace seedflow
