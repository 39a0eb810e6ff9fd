#include "seedflow/mesh/domain.h"

#include <deal.II/fe/mapping_q.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "seedflow/base/nearest_name.h"
#include "seedflow/mesh/gmsh_file.h"

namespace seedflow {

namespace {

constexpr const char* box_sides[3][2] = {{"left", "right"}, {"front", "back"}, {"bottom", "top"}};

template <int dim>
std::map<dealii::types::boundary_id, std::string> names_of_box() {
  std::map<dealii::types::boundary_id, std::string> names;
  for (int d = 0; d < dim; ++d)
    for (int s = 0; s < 2; ++s) names[2 * d + s] = box_sides[dim == 2 && d == 1 ? 2 : d][s];
  return names;
}

}  // namespace

void DomainParameters::declare(Parameters& p) {
  const auto section = p.section("Air domain", "The space filled by air and its mesh.");
  p.text("Mesh file", mesh_file,
         "Gmsh .msh file (ASCII) whose physical groups name the sides; empty: a box.");
  p.vector("Lower corner", lower, "m", Range::any(), "Corner of the box with the smallest coordinates.");
  p.vector("Upper corner", upper, "m", Range::any(), "Corner of the box with the largest coordinates.");
  p.numbers("Cells", cells, "1", Range::between(1, 100000),
            "Cells of the box per direction before refinement.");
  p.integer("Refinements", refinements, Range::between(0, 12), "Uniform refinements of the whole mesh.");
  p.texts("Periodic sides", periodic, "Pairs of opposite sides joined to one another, each like left-right.");
}

template <int dim>
Domain<dim>::Domain(const DomainParameters& p, MPI_Comm comm)
    : mesh(std::make_unique<Triangulation>(comm,
                                           dealii::Triangulation<dim>::limit_level_difference_at_vertices)) {
  if (!p.mesh_file.empty()) {
    const auto file = std::make_shared<GmshMesh<dim>>();
    read_gmsh(p.mesh_file, 1, *file);
    side_names = file->sides;
    build_coarse = [file](Triangulation& m) { m.copy_triangulation(file->coarse); };
  } else {
    std::vector<unsigned int> n;
    dealii::Point<dim> a, b;
    if (p.cells.size() != dim)
      throw InputError("Air domain/Cells: " + std::to_string(dim) +
                       " whole numbers are needed, one per direction; " + std::to_string(p.cells.size()) +
                       " given.");
    for (int d = 0; d < dim; ++d) {
      a[d] = p.lower[d];
      b[d] = p.upper[d];
      if (p.cells[d] < 1 || p.cells[d] != std::floor(p.cells[d]))
        throw InputError("Air domain/Cells: " + std::to_string(p.cells[d]) + " is not a whole number >= 1.");
      n.push_back(static_cast<unsigned int>(p.cells[d]));
      if (!(b[d] > a[d]))
        throw InputError(
            "Air domain/Upper corner must lie above Lower corner in every direction; direction " +
            std::to_string(d) + " has " + std::to_string(a[d]) + " to " + std::to_string(b[d]) + " m.");
    }
    side_names = names_of_box<dim>();
    build_coarse = [=](Triangulation& m) {
      dealii::GridGenerator::subdivided_hyper_rectangle(m, n, a, b, true);
    };
  }
  build_coarse(*mesh);
  name_periodic_sides(p.periodic);
  join_periodic_sides();
  if (p.refinements > 0) mesh->refine_global(p.refinements);
  require_cells_for_all_ranks();
}

template <int dim>
Domain<dim>::Domain(const dealii::Triangulation<dim>& given,
                    const std::map<dealii::types::boundary_id, std::string>& names,
                    const std::vector<std::string>& periodic, MPI_Comm comm)
    : mesh(std::make_unique<Triangulation>(comm,
                                           dealii::Triangulation<dim>::limit_level_difference_at_vertices)),
      side_names(names) {
  const auto coarse = std::make_shared<dealii::Triangulation<dim>>();
  coarse->copy_triangulation(given);
  build_coarse = [coarse](Triangulation& m) { m.copy_triangulation(*coarse); };
  build_coarse(*mesh);
  name_periodic_sides(periodic);
  join_periodic_sides();
}

template <int dim>
void Domain<dim>::name_periodic_sides(const std::vector<std::string>& periodic) {
  map = std::make_unique<dealii::MappingQ<dim>>(1);
  for (const auto id : mesh->get_boundary_ids())
    if (!side_names.count(id))
      throw InputError("The mesh has a side with id " + std::to_string(id) +
                       " without a name. Give every side of the air domain a named physical group.");
  for (const std::string& pair : periodic) {
    const auto dash = pair.find('-');
    if (dash == std::string::npos)
      throw InputError("Air domain/Periodic sides: \"" + pair + "\" is not a pair like left-right.");
    const std::string first = pair.substr(0, dash), second = pair.substr(dash + 1);
    const auto a = side(first);
    side(second);
    dealii::Tensor<1, dim> normal;
    for (const auto& cell : mesh->cell_iterators_on_level(0))
      for (unsigned int f = 0; f < cell->n_faces(); ++f)
        if (cell->face(f)->at_boundary() && cell->face(f)->boundary_id() == a)
          normal = cell->face(f)->center() - cell->center();
    int direction = 0;
    for (int d = 1; d < dim; ++d)
      if (std::abs(normal[d]) > std::abs(normal[direction])) direction = d;
    joined.push_back({first, second, direction});
  }
}

template <int dim>
void Domain<dim>::join_periodic_sides() {
  std::vector<dealii::GridTools::PeriodicFacePair<typename Triangulation::cell_iterator>> pairs;
  for (const Periodicity& p : joined)
    dealii::GridTools::collect_periodic_faces(*mesh, side(p.first), side(p.second), p.direction, pairs);
  if (!pairs.empty()) mesh->add_periodicity(pairs);
}

template <int dim>
dealii::types::boundary_id Domain<dim>::side(const std::string& name) const {
  std::vector<std::string> valid;
  for (const auto& [id, s] : side_names) {
    if (s == name) return id;
    valid.push_back(s);
  }
  throw InputError("The air domain has no side \"" + name + "\". " + suggestion(name, valid, "side"));
}

template <int dim>
bool Domain<dim>::is_periodic(const std::string& name) const {
  return std::any_of(joined.begin(), joined.end(),
                     [&](const Periodicity& p) { return p.first == name || p.second == name; });
}

template <int dim>
double Domain<dim>::volume() const {
  double v = 0;
  for (const auto& cell : mesh->active_cell_iterators())
    if (cell->is_locally_owned()) v += cell->measure();
  return dealii::Utilities::MPI::sum(v, communicator());
}

template <int dim>
double Domain<dim>::min_cell_size() const {
  double h = std::numeric_limits<double>::max();
  for (const auto& cell : mesh->active_cell_iterators())
    if (cell->is_locally_owned())
      for (unsigned int l = 0; l < cell->n_lines(); ++l)
        h = std::min(h, cell->line(l)->vertex(0).distance(cell->line(l)->vertex(1)));
  return dealii::Utilities::MPI::min(h, communicator());
}

template <int dim>
void Domain<dim>::require_cells_for_all_ranks() const {
  const auto cells = mesh->n_global_active_cells();
  const unsigned int ranks = dealii::Utilities::MPI::n_mpi_processes(communicator());
  if (dealii::Utilities::MPI::min(mesh->n_locally_owned_active_cells(), communicator()) == 0)
    throw InputError("The air mesh has " + std::to_string(cells) + " cells, too few for " +
                     std::to_string(ranks) + " ranks. Use fewer ranks (--mpi) or a finer mesh.");
}

template <int dim>
void Domain<dim>::save(const std::string& prefix) const {
  mesh->save(prefix);
}

template <int dim>
void Domain<dim>::load(const std::string& prefix) {
  present_angle = 0;
  at_rest.clear();
  changes_remembered = -1;
  if (mesh->n_global_levels() > 1 || turning) {
    mesh->clear();
    build_coarse(*mesh);
    join_periodic_sides();
  }
  mesh->load(prefix, false);  // keep the saved partition: the same ranks own the same cells
}

template <int dim>
void Domain<dim>::set_rotor(const Rotor<dim>& rotor) {
  std::vector<char> part(mesh->n_vertices(), 0);
  for (const auto& cell : mesh->cell_iterators_on_level(0))
    for (const unsigned int v : cell->vertex_indices())
      part[cell->vertex_index(v)] |= cell->material_id() == rotor.material ? 1 : 2;
  const auto shared = std::count(part.begin(), part.end(), 3);
  const std::string where = "The rotor (cells of material " + std::to_string(rotor.material) + ") ";
  if (std::count(part.begin(), part.end(), 1) == 0)
    throw InputError(where +
                     "has no cells. Give the cells that turn this material id (in Gmsh: the tag of "
                     "their Physical Volume).");
  if (shared > 0)
    throw InputError(where + "shares " + std::to_string(shared) +
                     " vertices with the rest of the mesh. Rotor and stator must be separate bodies: mesh "
                     "both surfaces of the sliding interface with vertices of their own.");
  if (dim == 3 && !(rotor.axis.norm() > 0)) throw InputError(where + "has an axis of length zero.");
  for (const auto& pair : rotor.pairs) {
    side(pair.rotor);
    side(pair.stator);
  }
  turning = std::make_unique<Rotor<dim>>(rotor);
  present_angle = 0;
  changes_remembered = -1;
  mesh->signals.any_change.connect([count = mesh_changes] { ++*count; });
}

template <int dim>
bool Domain<dim>::is_sliding(const std::string& name) const {
  return turning && std::any_of(turning->pairs.begin(), turning->pairs.end(),
                                [&](const auto& p) { return p.rotor == name || p.stator == name; });
}

template <int dim>
void Domain<dim>::remember_vertices() {
  if (changes_remembered == *mesh_changes) return;
  changes_remembered = *mesh_changes;
  at_rest.clear();
  std::vector<char> seen(mesh->n_vertices(), 0);
  for (const auto& cell : mesh->cell_iterators()) {
    if (cell->material_id() != turning->material) continue;
    for (const unsigned int v : cell->vertex_indices()) {
      const unsigned int i = cell->vertex_index(v);
      if (seen[i]) continue;
      seen[i] = 1;
      at_rest.emplace_back(
          i, present_angle == 0 ? cell->vertex(v) : turning->turned(cell->vertex(v), -present_angle));
    }
  }
}

template <int dim>
void Domain<dim>::turn_to(double angle) {
  if (!turning) throw InputError("The air domain has no rotor to turn.");
  if (angle == present_angle) return;
  remember_vertices();
  const auto rotation = turning->rotation(angle);
  auto& vertices = const_cast<std::vector<dealii::Point<dim>>&>(mesh->get_vertices());
  for (const auto& [i, x] : at_rest)
    vertices[i] = angle == 0 ? x : turning->centre + rotation * (x - turning->centre);
  present_angle = angle;
}

template <int dim>
std::vector<typename Domain<dim>::Triangulation::active_cell_iterator> Domain<dim>::cells_in_z_order() const {
  std::vector<typename Triangulation::active_cell_iterator> order;
  const std::function<void(const typename Triangulation::cell_iterator&)> visit =
      [&](const typename Triangulation::cell_iterator& cell) {
        if (cell->has_children())
          for (unsigned int c = 0; c < cell->n_children(); ++c) visit(cell->child(c));
        else if (cell->is_locally_owned())
          order.push_back(cell);
      };
  for (const auto& cell : mesh->cell_iterators_on_level(0)) visit(cell);
  return order;
}

template class Domain<2>;
template class Domain<3>;

}  // namespace seedflow
