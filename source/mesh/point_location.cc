#include "seedflow/mesh/point_location.h"

#include <deal.II/grid/cell_id.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace seedflow {

using dealii::Point;
using dealii::Triangulation;

namespace {

/// Copies the tree below `cell` and returns the entry that stands for it.
template <int dim>
std::int32_t copy_tree(const typename Triangulation<dim>::cell_iterator& cell,
                       const std::vector<std::vector<std::int32_t>>& owned_number,
                       std::vector<std::int32_t>& node) {
  if (cell->is_active())
    return cell->is_locally_owned() ? -2 - owned_number[cell->level()][cell->index()] : -1;
  const std::size_t first = node.size();
  node.resize(first + (1u << dim), -1);
  for (unsigned int child = 0; child < (1u << dim); ++child) {
    const std::int32_t entry = copy_tree<dim>(cell->child(child), owned_number, node);
    node[first + child] = entry;
  }
  return static_cast<std::int32_t>(first);
}

/// Whether the hanging nodes of a refined face lie off the face's own (bi-)linear shape.
template <int dim, typename Face>
bool bends(const Face& face) {
  constexpr int n = 1 << (dim - 1);
  const double scale = face->diameter();
  for (int child = 0; child < n; ++child)
    for (int v = 0; v < n; ++v) {
      dealii::Tensor<1, dim> off = face->child(child)->vertex(v);
      for (int w = 0; w < n; ++w) {
        double weight = 1;
        for (int d = 0; d < dim - 1; ++d) {
          const double t = 0.5 * ((child >> d & 1) + (v >> d & 1));
          weight *= w >> d & 1 ? t : 1 - t;
        }
        off -= weight * face->vertex(w);
      }
      if (off.norm() > 1e-8 * scale) return true;
    }
  return false;
}

}  // namespace

template <int dim>
void PointLocation<dim>::build(const Triangulation<dim>& triangulation, const Point<dim>& lower,
                               const Point<dim>& upper, const std::array<unsigned int, dim>& cells) {
  origin = lower;
  std::size_t n_roots = 1;
  for (int d = 0; d < dim; ++d) {
    coarse_cells[d] = static_cast<int>(cells[d]);
    coarse_size[d] = (upper[d] - lower[d]) / cells[d];
    inverse_coarse_size[d] = 1.0 / coarse_size[d];
    n_roots *= cells[d];
  }
  root.assign(n_roots, -1);
  node.clear();
  parts.clear();
  glance.clear();

  std::vector<std::vector<std::int32_t>> owned_number(triangulation.n_levels());
  for (unsigned int level = 0; level < triangulation.n_levels(); ++level)
    owned_number[level].assign(triangulation.n_raw_cells(level), -1);
  std::int32_t count = 0;
  for (const auto& cell : triangulation.active_cell_iterators())
    if (cell->is_locally_owned()) owned_number[cell->level()][cell->index()] = count++;

  std::size_t n_coarse = 0;
  for (const auto& cell : triangulation.cell_iterators_on_level(0)) {
    const auto offset = cell->center() - lower;
    std::size_t index = 0;
    for (int d = dim - 1; d >= 0; --d) {
      const double position = offset[d] * inverse_coarse_size[d];
      if (!(std::abs(position - std::floor(position) - 0.5) < 1e-6) || position < 0 || position > cells[d])
        throw std::logic_error(
            "PointLocation: the coarse mesh is not the box lattice it was announced to be");
      index = index * coarse_cells[d] + static_cast<int>(position);
    }
    root[index] = copy_tree<dim>(cell, owned_number, node);
    ++n_coarse;
  }
  if (n_coarse != n_roots) throw std::logic_error("PointLocation: the lattice has holes");
}

template <int dim>
void PointLocation<dim>::build(const Domain<dim>& domain) {
  using Cell = typename Domain<dim>::Triangulation::active_cell_iterator;
  struct Entry {
    Cell cell;
    dealii::CellId id;
    std::int32_t number;
  };
  rotor.reset();
  if (domain.rotor()) rotor = *domain.rotor();
  built_at = domain.angle();
  std::vector<std::vector<Entry>> entries(rotor ? 2 : 1);
  std::vector<char> hanging(domain.triangulation().n_vertices(), 0);
  std::int32_t count = 0;
  for (const auto& cell : domain.triangulation().active_cell_iterators()) {
    if (cell->is_artificial()) continue;
    entries[rotor && cell->material_id() == rotor->material].push_back(
        {cell, cell->id(), cell->is_locally_owned() ? count++ : not_here});
    for (const unsigned int f : cell->face_indices())
      if (cell->face(f)->has_children() && bends<dim>(cell->face(f)))
        for (unsigned int v = 0; v < dealii::GeometryInfo<dim>::vertices_per_face; ++v)
          hanging[cell->face(f)->vertex_index(v)] = 1;
  }
  root.clear();
  node.clear();
  parts.clear();
  glance.assign(count, {});
  for (auto& group : entries) {
    // The order is that of the whole mesh, so that all ranks decide alike.
    std::sort(group.begin(), group.end(), [](const Entry& a, const Entry& b) { return a.id < b.id; });
    std::vector<MultilinearCell<dim>> cells;
    for (const Entry& entry : group) {
      std::array<Point<dim>, 1 << dim> vertices;
      const auto corners = domain.mapping().get_vertices(entry.cell);
      std::copy(corners.begin(), corners.end(), vertices.begin());
      cells.emplace_back(vertices);
      cells.back().number = entry.number;
      // A cell of a coarse face, or next to one: its vertices are those of that face.
      const auto touches = [&](const auto& of) {
        for (const unsigned int v : of->vertex_indices())
          if (hanging[of->vertex_index(v)]) return true;
        return false;
      };
      cells.back().alone =
          !touches(entry.cell) && (entry.cell->level() == 0 || !touches(entry.cell->parent()));
      if (!cells.back().alone) cells.back().reach = gap;
      if (entry.number != not_here) glance[entry.number] = glance_at(cells.back(), parts.size());
    }
    parts.push_back({CellBins<dim>(std::move(cells)), false, {}, {}});
  }
}

template <int dim>
typename PointLocation<dim>::Glance PointLocation<dim>::glance_at(const MultilinearCell<dim>& cell,
                                                                  std::uint32_t part) {
  Glance g;
  g.part = part;
  double steepest = 0, farthest = 0;
  for (int d = 0; d < dim; ++d) {
    g.centre[d] = static_cast<float>(cell.coefficient[0][d]);
    farthest = std::max(farthest, std::abs(cell.coefficient[0][d]));
    double sum = 0;
    for (int e = 0; e < dim; ++e) {
      g.inverse[d][e] = static_cast<float>(cell.inverse[d][e]);
      sum += std::abs(cell.inverse[d][e]);
    }
    steepest = std::max(steepest, sum);
  }
  // Beyond the bend (see MultilinearCell::outside), 1e-6 is sixteen times the rounding of the floats.
  if (cell.alone) g.limit = static_cast<float>(0.5 - cell.bend - 1e-6 * (1 + steepest * farthest));
  return g;
}

template <int dim>
void PointLocation<dim>::turn_to(double angle) {
  if (!rotor) throw std::logic_error("PointLocation: nothing turns in this domain");
  Part& part = parts.back();
  part.turned = angle != built_at;
  part.centre = rotor->centre;
  part.back = rotor->rotation(built_at - angle);
}

template <int dim>
std::size_t PointLocation<dim>::memory_consumption() const {
  std::size_t bytes = (root.capacity() + node.capacity()) * sizeof(std::int32_t) +
                      glance.capacity() * sizeof(Glance) + sizeof(*this);
  for (const Part& part : parts) bytes += part.bins.memory_consumption();
  return bytes;
}

template <int dim>
int PointLocation<dim>::cell_of(const Point<dim>& point, int guess) const {
  if (!parts.empty()) {
    if (guess >= 0 && guess < static_cast<int>(glance.size()) &&  // it may stem from an older mesh
        glance[guess].holds(parts[glance[guess].part].before(point)))
      return guess;
    typename CellBins<dim>::Found found;
    for (const Part& part : parts)
      if (!found.certain) part.bins.search(part.before(point), found);
    return found.number;
  }
  std::array<double, dim> fraction;
  std::size_t index = 0;
  for (int d = dim - 1; d >= 0; --d) {
    const double position = (point[d] - origin[d]) * inverse_coarse_size[d];
    if (!(position >= 0.0 && position <= coarse_cells[d])) return not_here;
    int i = static_cast<int>(position);
    if (i == coarse_cells[d]) --i;  // the upper boundary belongs to the last cell
    fraction[d] = position - i;
    index = index * coarse_cells[d] + i;
  }
  std::int32_t entry = root[index];
  while (entry >= 0) {
    int child = 0;
    for (int d = 0; d < dim; ++d) {
      fraction[d] *= 2.0;
      const int upper = fraction[d] >= 1.0;
      fraction[d] -= upper;
      child |= upper << d;
    }
    entry = node[entry + child];
  }
  return leaf_to_cell(entry);
}

template class PointLocation<2>;
template class PointLocation<3>;

}  // namespace seedflow
