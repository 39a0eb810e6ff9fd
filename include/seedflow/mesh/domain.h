#pragma once

#include <deal.II/distributed/tria.h>
#include <deal.II/fe/mapping.h>

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "seedflow/base/parameters.h"
#include "seedflow/mesh/rotor.h"

namespace seedflow {

/// What the air fills: a box of named sides, or a Gmsh mesh. Section "Air domain".
struct DomainParameters {
  std::string mesh_file;               ///< "" = the box below
  Vec3 lower{0, 0, 0};                 ///< [m]
  Vec3 upper{1, 1, 1};                 ///< [m]
  std::vector<double> cells{8, 8, 8};  ///< coarse cells per direction, whole numbers
  int refinements = 0;                 ///< uniform refinements after reading or building the coarse mesh
  /// Pairs of opposite sides joined to one another, each "left-right".
  std::vector<std::string> periodic;

  void declare(Parameters& parameters);
};

/// The meshed domain of the air, distributed over the ranks, with names for its sides.
///
/// The sides of a box are left/right (x-/x+), front/back (y-/y+), bottom/top (z-/z+); in two dimensions
/// left/right and bottom/top (y-/y+). The sides of a Gmsh mesh carry the names of its physical groups.
///
/// Errors: InputError for an empty box, an unreadable or unnamed mesh, an unknown side, more ranks than
/// cells.
template <int dim>
class Domain {
 public:
  using Triangulation = dealii::parallel::distributed::Triangulation<dim>;
  /// Two sides joined, and the direction (0, 1, 2) along which they face one another.
  struct Periodicity {
    std::string first, second;
    int direction;
  };

  Domain(const DomainParameters& parameters, MPI_Comm comm);
  /// From a coarse mesh whose boundary ids are named by `names`.
  Domain(const dealii::Triangulation<dim>& coarse,
         const std::map<dealii::types::boundary_id, std::string>& names,
         const std::vector<std::string>& periodic, MPI_Comm comm);

  Triangulation& triangulation() { return *mesh; }
  const Triangulation& triangulation() const { return *mesh; }
  const dealii::Mapping<dim>& mapping() const { return *map; }
  MPI_Comm communicator() const { return mesh->get_communicator(); }

  const std::map<dealii::types::boundary_id, std::string>& sides() const { return side_names; }
  /// Errors: InputError naming the nearest side.
  dealii::types::boundary_id side(const std::string& name) const;
  bool is_periodic(const std::string& name) const;
  const std::vector<Periodicity>& periodicities() const { return joined; }

  /// A part of the mesh turns from now on; the mesh is at angle 0 now. Before anything (Fluid, point
  /// location) is built on the domain. Errors: InputError if no cell has the rotor's material, if rotor and
  /// stator share vertices, or if a pair names an unknown side.
  void set_rotor(const Rotor<dim>& rotor);
  const Rotor<dim>* rotor() const { return turning.get(); }  ///< null: nothing turns
  /// Whether this side slides over another, see Rotor::pairs.
  bool is_sliding(const std::string& name) const;
  /// Turns the rotor's vertices to this angle [rad] from where they were in set_rotor(). Turning back to an
  /// angle gives the same vertices to the last bit. All ranks; done for you by Fluid::turn_to.
  void turn_to(double angle);
  double angle() const { return present_angle; }

  double volume() const;         ///< [m^dim], all ranks
  double min_cell_size() const;  ///< shortest edge [m], all ranks

  /// Errors: InputError if a rank would have no cell.
  void require_cells_for_all_ranks() const;

  /// The mesh as p4est files with this prefix; all ranks. load() needs a domain constructed from the same
  /// parameters on as many ranks, and comes before anything (Fluid, point location) is built on the domain.
  void save(const std::string& prefix) const;
  void load(const std::string& prefix);

  /// The locally owned active cells in hierarchical (Z) order: unlike the traversal order it depends on the
  /// mesh alone and not on how refinement led to it. Each is given by its number in the traversal order.
  std::vector<typename Triangulation::active_cell_iterator> cells_in_z_order() const;

 private:
  void remember_vertices();
  void name_periodic_sides(const std::vector<std::string>& pairs);
  void join_periodic_sides();

  std::function<void(Triangulation&)> build_coarse;
  std::unique_ptr<Triangulation> mesh;
  std::unique_ptr<dealii::Mapping<dim>> map;
  std::map<dealii::types::boundary_id, std::string> side_names;
  std::vector<Periodicity> joined;
  std::unique_ptr<Rotor<dim>> turning;
  double present_angle = 0;
  std::shared_ptr<int> mesh_changes = std::make_shared<int>(0);
  int changes_remembered = -1;
  std::vector<std::pair<unsigned int, dealii::Point<dim>>> at_rest;  ///< the rotor's vertices at angle 0
};

}  // namespace seedflow
