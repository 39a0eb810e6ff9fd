#include "seedflow/fluid/nodal_space.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_renumbering.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_values.h>

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace seedflow {

template <int dim, int degree>
NodalSpace<dim, degree>::NodalSpace(const Domain<dim>& domain) : fe(degree), dofs(domain.triangulation()) {
  rebuild(domain);
}

template <int dim, int degree>
void NodalSpace<dim, degree>::rebuild(const Domain<dim>& domain) {
  n_groups = n_free_groups = 0;
  layout = {};
  for (auto* v : {&node, &cell, &place, &position, &first_jacobian}) v->clear();
  for (auto* v : {&used, &jacobian_stride}) v->clear();
  constrained.clear();
  jacobian.clear();
  constrained_cells.clear();
  lines.clear();
  turning.clear();
  jacobian_at_rest.clear();
  position_at_rest.clear();
  number_nodes(domain);
  group_cells(domain);
  compute_geometry(domain);
  if (domain.rotor()) find_turning_cells(domain);
}

template <int dim, int degree>
void NodalSpace<dim, degree>::number_nodes(const Domain<dim>& domain) {
  dofs.distribute_dofs(fe);
  dealii::DoFRenumbering::hierarchical(dofs);  // depends on the mesh alone, not on how it was refined
  const dealii::IndexSet owned = dofs.locally_owned_dofs();
  const dealii::IndexSet relevant = dealii::DoFTools::extract_locally_relevant_dofs(dofs);
  constraints.reinit(relevant);
  dealii::DoFTools::make_hanging_node_constraints(dofs, constraints);
  for (const auto& p : domain.periodicities())
    dealii::DoFTools::make_periodicity_constraints(dofs, domain.side(p.first), domain.side(p.second),
                                                   p.direction, constraints);
  constraints.make_consistent_in_parallel(owned, constraints.get_local_lines(), domain.communicator());
  constraints.close();
  // Masters of constrained nodes may lie beyond the cells next to this rank (chains across periodic sides).
  dealii::IndexSet written = relevant;
  for (const auto i : relevant)
    if (const auto* entries = constraints.get_constraint_entries(i))
      for (const auto& [master, weight] : *entries) written.add_index(master);
  dealii::DynamicSparsityPattern pattern(dofs.n_dofs(), dofs.n_dofs(), written);
  std::vector<dealii::types::global_dof_index> ids(n);
  for (const auto& c : dofs.active_cell_iterators())
    if (c->is_locally_owned()) {
      c->get_dof_indices(ids);
      constraints.add_entries_local_to_global(ids, pattern, false);
    }
  for (const auto i : owned) pattern.add(i, i);
  structure =
      std::make_shared<SparsityStructure>(pattern, owned, written, domain.communicator(),
                                          domain.rotor() ? nodes_at_interface(domain) : dealii::IndexSet());

  const auto& partitioner = *structure->partitioner;
  constrained.assign(partitioner.locally_owned_size() + partitioner.n_ghost_indices(), 0);
  for (const auto i : relevant)
    if (const auto* entries = constraints.get_constraint_entries(i)) {
      Line line{partitioner.global_to_local(i), {}};
      constrained[line.node] = 1;
      for (const auto& [master, weight] : *entries)
        line.entries.emplace_back(partitioner.global_to_local(master), weight);
      lines.push_back(line);
    }
}

template <int dim, int degree>
void NodalSpace<dim, degree>::group_cells(const Domain<dim>& domain) {
  const auto& partitioner = *structure->partitioner;
  struct Member {
    std::uint32_t cell;
    std::vector<std::uint32_t> nodes;
  };
  std::vector<Member> free, bound;
  std::vector<std::uint32_t> number(domain.triangulation().n_active_cells());
  std::uint32_t count = 0;
  for (const auto& c : dofs.active_cell_iterators())
    if (c->is_locally_owned()) number[c->active_cell_index()] = count++;
  std::vector<dealii::types::global_dof_index> ids(n);
  for (const auto& c : domain.cells_in_z_order()) {
    const typename dealii::DoFHandler<dim>::active_cell_iterator d(&domain.triangulation(), c->level(),
                                                                   c->index(), &dofs);
    d->get_dof_indices(ids);
    Member m{number[c->active_cell_index()], {}};
    bool is_free = true;
    for (const auto i : ids) {
      m.nodes.push_back(partitioner.global_to_local(i));
      is_free = is_free && !constrained[m.nodes.back()];
    }
    (is_free ? free : bound).push_back(std::move(m));
  }
  place.resize(count);
  const auto fill = [&](const std::vector<Member>& members) {
    for (std::size_t first = 0; first < members.size(); first += W, ++n_groups) {
      used.push_back(std::min<std::size_t>(W, members.size() - first));
      node.resize((n_groups + 1) * n * W);
      for (int l = 0; l < W; ++l) {
        const Member& m = members[first + (l < used.back() ? l : 0)];
        cell.push_back(m.cell);
        if (l < used.back()) place[m.cell] = n_groups * W + l;
        for (int i = 0; i < n; ++i) node[(n_groups * n + i) * W + l] = m.nodes[i];
      }
    }
  };
  fill(free);
  n_free_groups = n_groups;
  fill(bound);

  position.resize(n_free_groups * n * n * W);
  for (std::size_t g = 0; g < n_free_groups; ++g)
    for (int l = 0; l < W; ++l)
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j)
          position[((g * n + i) * n + j) * W + l] =
              structure->position(node[(g * n + i) * W + l], node[(g * n + j) * W + l]);

  std::unordered_map<std::uint32_t, std::size_t> line_of;
  for (std::size_t k = 0; k < lines.size(); ++k) line_of[lines[k].node] = k;
  constrained_cells.resize((n_groups - n_free_groups) * W);
  for (std::size_t g = n_free_groups; g < n_groups; ++g)
    for (int l = 0; l < used[g]; ++l) {
      ConstrainedCell& c = constrained_cells[(g - n_free_groups) * W + l];
      std::vector<std::vector<std::pair<std::uint32_t, double>>> expansion(n);
      for (int i = 0; i < n; ++i) {
        const std::uint32_t local = node[(g * n + i) * W + l];
        if (constrained[local]) {
          expansion[i] = lines[line_of.at(local)].entries;
        } else {
          expansion[i] = {{local, 1.0}};
        }
        for (const auto& e : expansion[i]) c.masters.push_back(e.first);
      }
      std::sort(c.masters.begin(), c.masters.end());
      c.masters.erase(std::unique(c.masters.begin(), c.masters.end()), c.masters.end());
      const std::size_t m = c.masters.size();
      c.weight.assign(n * m, 0.0);
      for (int i = 0; i < n; ++i)
        for (const auto& e : expansion[i])
          c.weight[i * m + (std::lower_bound(c.masters.begin(), c.masters.end(), e.first) -
                            c.masters.begin())] += e.second;
      for (const auto row : c.masters)
        for (const auto column : c.masters) c.positions.push_back(structure->position(row, column));
    }
}

template <int dim, int degree>
void NodalSpace<dim, degree>::compute_geometry(const Domain<dim>& domain) {
  const dealii::QGauss<dim> rule(degree + 1);
  dealii::FEValues<dim> values(
      domain.mapping(), fe, rule,
      dealii::update_inverse_jacobians | dealii::update_JxW_values | dealii::update_quadrature_points);
  layout.n_cells = place.size();
  layout.n_q = n_q;
  layout.position.resize(place.size() * n_q);
  layout.JxW.resize(place.size() * n_q);
  layout.cell_volume.assign(place.size(), 0.0);
  std::vector<double> inverse(place.size() * n_q * dim * dim);
  std::vector<char> affine(place.size(), 1);
  std::vector<std::uint32_t> number(domain.triangulation().n_active_cells());
  std::uint32_t count = 0;
  for (const auto& active : domain.triangulation().active_cell_iterators())
    if (active->is_locally_owned()) number[active->active_cell_index()] = count++;
  // In Z order: FEValues reuses values of a similar cell before, so the last bits depend on the order.
  for (const auto& active : domain.cells_in_z_order()) {
    const std::uint32_t c = number[active->active_cell_index()];
    values.reinit(active);
    double largest = 0, difference = 0;
    for (int q = 0; q < n_q; ++q) {
      layout.position[c * n_q + q] = values.quadrature_point(q);
      layout.JxW[c * n_q + q] = values.JxW(q);
      layout.cell_volume[c] += values.JxW(q);
      for (int e = 0; e < dim; ++e)
        for (int d = 0; d < dim; ++d) {
          const double a = values.inverse_jacobian(q)[e][d];
          inverse[((c * n_q + q) * dim + e) * dim + d] = a;
          largest = std::max(largest, std::abs(a));
          difference = std::max(difference, std::abs(a - values.inverse_jacobian(0)[e][d]));
        }
    }
    affine[c] = difference < 1e-12 * largest;
  }
  for (std::size_t g = 0; g < n_groups; ++g) {
    bool all = true;
    for (int l = 0; l < W; ++l) all = all && affine[cell[g * W + l]];
    first_jacobian.push_back(jacobian.size() / (dim * dim + 1));
    jacobian_stride.push_back(!all);
    for (int q = 0; q < (all ? 1 : n_q); ++q) {
      Lanes block[dim * dim + 1];
      for (int l = 0; l < W; ++l) {
        const std::uint32_t at = cell[g * W + l] * n_q + q;
        for (int k = 0; k < dim * dim; ++k) block[k][l] = inverse[at * dim * dim + k];
        block[dim * dim][l] = l < used[g] ? layout.JxW[at] / shape.weight[q] : 0.0;
      }
      jacobian.insert(jacobian.end(), block, block + dim * dim + 1);
    }
  }
}

template <int dim, int degree>
void NodalSpace<dim, degree>::scatter(const Lanes* in, std::size_t group, NodalVector& y) const {
  double* value = y.begin();
  if (group < n_free_groups) {
    const std::uint32_t* index = node.data() + group * n * W;
    for (int i = 0; i < n; ++i)
      for (int l = 0; l < W; ++l) value[index[i * W + l]] += in[i][l];
    return;
  }
  for (int l = 0; l < used[group]; ++l) {
    const ConstrainedCell& c = constrained_cells[(group - n_free_groups) * W + l];
    const std::size_t m = c.masters.size();
    for (std::size_t a = 0; a < m; ++a) {
      double sum = 0;
      for (int i = 0; i < n; ++i) sum += c.weight[i * m + a] * in[i][l];
      value[c.masters[a]] += sum;
    }
  }
}

template <int dim, int degree>
void NodalSpace<dim, degree>::add(const double* in, std::uint32_t at, NodalVector& y) const {
  const std::size_t group = at / W, l = at % W;
  if (group < n_free_groups) {
    for (int i = 0; i < n; ++i) y.local_element(node[(group * n + i) * W + l]) += in[i];
    return;
  }
  const ConstrainedCell& c = constrained_cells[(group - n_free_groups) * W + l];
  const std::size_t m = c.masters.size();
  for (std::size_t a = 0; a < m; ++a) {
    double sum = 0;
    for (int i = 0; i < n; ++i) sum += c.weight[i * m + a] * in[i];
    y.local_element(c.masters[a]) += sum;
  }
}

template <int dim, int degree>
void NodalSpace<dim, degree>::scatter(const Lanes* in, std::size_t group, SparseMatrix& matrix) const {
  double* value = matrix.value.data();
  if (group < n_free_groups) {
    const std::uint32_t* index = position.data() + group * n * n * W;
    for (int k = 0; k < n * n; ++k)
      for (int l = 0; l < W; ++l) value[index[k * W + l]] += in[k][l];
    return;
  }
  std::vector<double> half;
  for (int l = 0; l < used[group]; ++l) {
    const ConstrainedCell& c = constrained_cells[(group - n_free_groups) * W + l];
    const std::size_t m = c.masters.size();
    half.assign(n * m, 0.0);
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j)
        for (std::size_t b = 0; b < m; ++b) half[i * m + b] += in[i * n + j][l] * c.weight[j * m + b];
    for (std::size_t a = 0; a < m; ++a)
      for (std::size_t b = 0; b < m; ++b) {
        double sum = 0;
        for (int i = 0; i < n; ++i) sum += c.weight[i * m + a] * half[i * m + b];
        value[c.positions[a * m + b]] += sum;
      }
  }
}

template <int dim, int degree>
void NodalSpace<dim, degree>::set_constrained(NodalVector& x) const {
  for (const Line& line : lines) {
    double sum = 0;
    for (const auto& [master, weight] : line.entries) sum += weight * x.local_element(master);
    x.local_element(line.node) = sum;
  }
}

template <int dim, int degree>
double NodalSpace<dim, degree>::bytes() const {
  double sum = (node.size() + cell.size() + place.size() + position.size() + first_jacobian.size()) * 4.0 +
               used.size() + jacobian_stride.size() + constrained.size() + jacobian.size() * sizeof(Lanes) +
               layout.JxW.size() * 8.0 + layout.position.size() * 8.0 * dim +
               layout.cell_volume.size() * 8.0 + structure->column.size() * 4.0 +
               structure->row_start.size() * 8.0 + dofs.memory_consumption();
  for (const auto& c : constrained_cells)
    sum += (c.masters.size() + c.positions.size()) * 4.0 + c.weight.size() * 8.0;
  return sum;
}

template class NodalSpace<2, 1>;
template class NodalSpace<3, 1>;
template class NodalSpace<2, 2>;
template class NodalSpace<3, 2>;

}  // namespace seedflow
