#include "seedflow/mesh/gmsh_file.h"

#include <deal.II/grid/grid_in.h>
#include <deal.II/grid/grid_tools.h>

#include <fstream>
#include <ostream>
#include <vector>

#include "seedflow/base/error.h"

namespace seedflow {

namespace {

[[noreturn]] void refuse(const std::string& file, const std::string& reason) {
  throw InputError("Mesh file \"" + file + "\" " + reason);
}

/// Section $PhysicalNames and the kind of file.
template <int dim>
void read_names(const std::string& file, GmshMesh<dim>& mesh) {
  std::ifstream in(file);
  if (!in) refuse(file, "cannot be read. Give the path of a Gmsh .msh file.");
  for (std::string line; std::getline(in, line);) {
    if (line.rfind("$MeshFormat", 0) == 0) {
      double version = 0;
      int binary = 0;
      if (in >> version >> binary && binary != 0)
        refuse(file, "is binary. Write it as ASCII (Mesh.Binary = 0).");
    }
    if (line.rfind("$PhysicalNames", 0) != 0) continue;
    int n = 0;
    in >> n;
    for (int i = 0; i < n; ++i) {
      int d = 0, id = 0;
      std::string name;
      in >> d >> id >> std::ws;
      std::getline(in, name);
      const auto open = name.find('"'), close = name.rfind('"');
      if (!in || open == std::string::npos || close <= open)
        throw InputError("Mesh file \"" + file + "\": section $PhysicalNames is malformed at entry " +
                         std::to_string(i + 1) + ".");
      name = name.substr(open + 1, close - open - 1);
      if (d == dim - 1) mesh.sides[id] = name;
      if (d == dim) mesh.parts[id] = name;
    }
  }
  if (mesh.sides.empty())
    refuse(file,
           "names no sides. Give every side of the air domain a Physical Surface (in 2D a Physical Curve) "
           "with a name, and the volume a Physical Volume, and write it as ASCII.");
}

}  // namespace

template <int dim>
void read_gmsh(const std::string& file, double unit, GmshMesh<dim>& mesh) {
  read_names(file, mesh);
  dealii::GridIn<dim> reader(mesh.coarse);
  std::ifstream in(file);
  const std::string wanted = std::string("is not a mesh of ") + (dim == 2 ? "quadrilaterals" : "hexahedra") +
                             " in Gmsh's ASCII format 2 or 4: ";
  try {
    reader.read_msh(in);
  } catch (const std::exception& e) {
    refuse(file, wanted + e.what());
  }
  if (!mesh.coarse.all_reference_cells_are_hyper_cube())
    refuse(file, wanted +
                     "it has triangles, tetrahedra, prisms or pyramids. Mesh transfinite volumes, recombine "
                     "and extrude, or subdivide all cells (Mesh.SubdivisionAlgorithm = 2).");
  if (unit != 1) dealii::GridTools::scale(unit, mesh.coarse);
}

void write_gmsh(const dealii::Triangulation<3>& coarse,
                const std::map<dealii::types::boundary_id, std::string>& sides,
                const std::map<dealii::types::material_id, std::string>& parts, double unit,
                std::ostream& out) {
  const auto first_of = [](const auto& names) { return !names.empty() && names.begin()->first == 0 ? 1 : 0; };
  const unsigned int side_tag = first_of(sides), part_tag = first_of(parts);
  out.precision(17);
  out << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n" << sides.size() + parts.size() << "\n";
  for (const auto& [id, name] : sides) out << "2 " << id + side_tag << " \"" << name << "\"\n";
  for (const auto& [id, name] : parts) out << "3 " << id + part_tag << " \"" << name << "\"\n";
  out << "$EndPhysicalNames\n$Nodes\n" << coarse.n_vertices() << "\n";
  for (unsigned int v = 0; v < coarse.n_vertices(); ++v) {
    const auto& x = coarse.get_vertices()[v];
    out << v + 1 << " " << x[0] / unit << " " << x[1] / unit << " " << x[2] / unit << "\n";
  }
  // Gmsh goes around each face, deal.II along its axes.
  constexpr unsigned int around[] = {0, 1, 3, 2, 4, 5, 7, 6};
  std::size_t n = coarse.n_active_cells();
  for (const auto& cell : coarse.active_cell_iterators())
    for (const unsigned int f : cell->face_indices()) n += cell->face(f)->at_boundary();
  out << "$EndNodes\n$Elements\n" << n << "\n";
  std::size_t number = 0;
  const auto element = [&](int kind, unsigned int tag, const auto& item, int corners) {
    out << ++number << " " << kind << " 2 " << tag << " " << tag;
    for (int c = 0; c < corners; ++c) out << " " << item->vertex_index(around[c]) + 1;
    out << "\n";
  };
  for (const auto& cell : coarse.active_cell_iterators())
    for (const unsigned int f : cell->face_indices())
      if (cell->face(f)->at_boundary()) element(3, cell->face(f)->boundary_id() + side_tag, cell->face(f), 4);
  for (const auto& cell : coarse.active_cell_iterators()) element(5, cell->material_id() + part_tag, cell, 8);
  out << "$EndElements\n";
}

template void read_gmsh<2>(const std::string&, double, GmshMesh<2>&);
template void read_gmsh<3>(const std::string&, double, GmshMesh<3>&);

}  // namespace seedflow
