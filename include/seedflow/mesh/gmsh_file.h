#pragma once

#include <deal.II/grid/tria.h>

#include <iosfwd>
#include <map>
#include <string>

namespace seedflow {

/// A mesh of a Gmsh file: quadrilaterals (2D) or hexahedra (3D).
template <int dim>
struct GmshMesh {
  dealii::Triangulation<dim> coarse;                        ///< [m]
  std::map<dealii::types::boundary_id, std::string> sides;  ///< names of the physical groups of dim - 1
  std::map<dealii::types::material_id, std::string> parts;  ///< names of the physical groups of dim
};

/// Reads an ASCII .msh file of format 2 or 4 into `mesh`; boundary and material ids are the tags of the
/// physical groups. `unit`: what 1 means in the file [m]. Errors: InputError naming the file and the remedy
/// if it cannot be read, is binary, has other cells, or names no sides.
template <int dim>
void read_gmsh(const std::string& file, double unit, GmshMesh<dim>& mesh);

/// Writes an unrefined mesh in ASCII format 2.2, with its names. Ids become tags, one higher where ids begin
/// at 0, which Gmsh keeps for "no group".
void write_gmsh(const dealii::Triangulation<3>& coarse,
                const std::map<dealii::types::boundary_id, std::string>& sides,
                const std::map<dealii::types::material_id, std::string>& parts, double unit,
                std::ostream& out);

}  // namespace seedflow
