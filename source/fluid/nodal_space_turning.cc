#include "seedflow/fluid/nodal_space.h"

#include <algorithm>

namespace seedflow {

template <int dim, int degree>
dealii::IndexSet NodalSpace<dim, degree>::nodes_at_interface(const Domain<dim>& domain) const {
  std::vector<dealii::types::global_dof_index> mine, ids(n);
  for (const auto& c : dofs.active_cell_iterators()) {
    if (!c->is_locally_owned()) continue;
    bool slides = false;
    for (const unsigned int f : c->face_indices())
      slides = slides ||
               (c->face(f)->at_boundary() && domain.is_sliding(domain.sides().at(c->face(f)->boundary_id())));
    if (!slides) continue;
    c->get_dof_indices(ids);
    for (const auto i : ids) {
      mine.push_back(i);
      if (const auto* entries = constraints.get_constraint_entries(i))
        for (const auto& [master, weight] : *entries) mine.push_back(master);
    }
  }
  dealii::IndexSet all(dofs.n_dofs());
  for (auto& list : dealii::Utilities::MPI::all_gather(domain.communicator(), mine)) {
    std::sort(list.begin(), list.end());
    all.add_indices(list.begin(), std::unique(list.begin(), list.end()));
  }
  return all;
}

template <int dim, int degree>
std::vector<std::pair<std::uint32_t, double>> NodalSpace<dim, degree>::masters(std::uint32_t at,
                                                                               int i) const {
  const std::size_t group = at / W, l = at % W;
  if (group < n_free_groups) return {{node[(group * n + i) * W + l], 1.0}};
  const ConstrainedCell& c = constrained_cells[(group - n_free_groups) * W + l];
  std::vector<std::pair<std::uint32_t, double>> result;
  const std::size_t m = c.masters.size();
  for (std::size_t a = 0; a < m; ++a)
    if (c.weight[i * m + a] != 0) result.emplace_back(c.masters[a], c.weight[i * m + a]);
  return result;
}

template <int dim, int degree>
void NodalSpace<dim, degree>::find_turning_cells(const Domain<dim>& domain) {
  std::vector<char> turns(place.size(), 0);
  std::uint32_t count = 0;
  for (const auto& c : domain.triangulation().active_cell_iterators())
    if (c->is_locally_owned()) turns[count++] = c->material_id() == domain.rotor()->material;
  for (std::uint32_t g = 0; g < n_groups; ++g) {
    TurningGroup t{g, broadcast(0.0)};
    bool any = false;
    for (int l = 0; l < W; ++l)
      if (turns[cell[g * W + l]]) {
        t.turns[l] = 1;
        any = true;
      }
    if (!any) continue;
    turning.push_back(t);
    const std::size_t size = dim * dim + 1, points = jacobian_stride[g] ? n_q : 1;
    const auto begin = jacobian.begin() + first_jacobian[g] * size;
    jacobian_at_rest.insert(jacobian_at_rest.end(), begin, begin + points * size);
  }
  for (std::uint32_t c = 0; c < count; ++c)
    for (int q = 0; turns[c] && q < n_q; ++q)
      position_at_rest.emplace_back(c * n_q + q, layout.position[c * n_q + q]);
}

template <int dim, int degree>
void NodalSpace<dim, degree>::turn_to(const Rotor<dim>& rotor, double angle) {
  const auto rotation = rotor.rotation(angle);
  constexpr int size = dim * dim + 1;
  std::size_t k = 0;
  for (const TurningGroup& t : turning) {
    Lanes r[dim][dim];  // one where the cell stands
    for (int a = 0; a < dim; ++a)
      for (int b = 0; b < dim; ++b)
        r[a][b] = t.turns * rotation[a][b] + (1.0 - t.turns) * (a == b ? 1.0 : 0.0);
    const int points = jacobian_stride[t.group] ? n_q : 1;
    Lanes* out = jacobian.data() + first_jacobian[t.group] * size;
    for (int q = 0; q < points; ++q, k += size, out += size)
      for (int e = 0; e < dim; ++e)
        for (int d = 0; d < dim; ++d) {
          Lanes sum = jacobian_at_rest[k + e * dim] * r[d][0];
          for (int b = 1; b < dim; ++b) sum += jacobian_at_rest[k + e * dim + b] * r[d][b];
          out[e * dim + d] = sum;
        }
  }
  for (const auto& [i, x] : position_at_rest)
    layout.position[i] = angle == 0 ? x : rotor.centre + rotation * (x - rotor.centre);
}

#define SEEDFLOW_TURNING(dim, degree)                                                                    \
  template dealii::IndexSet NodalSpace<dim, degree>::nodes_at_interface(const Domain<dim>&) const;       \
  template std::vector<std::pair<std::uint32_t, double>> NodalSpace<dim, degree>::masters(std::uint32_t, \
                                                                                          int) const;    \
  template void NodalSpace<dim, degree>::find_turning_cells(const Domain<dim>&);                         \
  template void NodalSpace<dim, degree>::turn_to(const Rotor<dim>&, double);
SEEDFLOW_TURNING(2, 1)
SEEDFLOW_TURNING(3, 1)
SEEDFLOW_TURNING(2, 2)
SEEDFLOW_TURNING(3, 2)

}  // namespace seedflow
