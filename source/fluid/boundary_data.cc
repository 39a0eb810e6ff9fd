#include "seedflow/fluid/boundary_data.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_dgq.h>
#include <deal.II/fe/fe_values.h>

#include <algorithm>
#include <cmath>

namespace seedflow {

namespace {

int rank_of(BoundaryType type) {
  switch (type) {
    case BoundaryType::wall:
      return 0;
    case BoundaryType::moving_wall:
    case BoundaryType::rotor_wall:
      return 1;
    case BoundaryType::velocity_inlet:
      return 2;
    case BoundaryType::slip:
      return 3;
    case BoundaryType::pressure_inlet:
      return 4;
    default:
      return 5;
  }
}
bool gives_pressure(BoundaryType type) {
  return type == BoundaryType::pressure_inlet || type == BoundaryType::pressure_outlet;
}
bool gives_velocity(BoundaryType type) {
  return rank_of(type) <= 2;
}

}  // namespace

template <int dim, int degree>
bool BoundaryData<dim, degree>::is_inlet(int side) const {
  return condition[side].type == BoundaryType::pressure_inlet;
}

template <int dim, int degree>
bool BoundaryData<dim, degree>::is_open(int side) const {
  return gives_pressure(condition[side].type);
}

template <int dim, int degree>
bool BoundaryData<dim, degree>::lets_through(int side) const {
  const BoundaryType type = condition[side].type;
  return gives_pressure(type) || type == BoundaryType::velocity_inlet || type == BoundaryType::moving_wall;
}

template <int dim, int degree>
BoundaryData<dim, degree>::BoundaryData(const Space& s, const Domain<dim>& domain,
                                        const BoundaryConditions<dim>& conditions)
    : space(s) {
  std::map<dealii::types::boundary_id, int> index;
  has_rotor = domain.rotor() != nullptr;
  if (has_rotor) rotor = *domain.rotor();
  std::vector<char> node_turns(s.constrained.size(), 0);
  for (const auto& [id, name] : domain.sides()) {
    if (domain.is_periodic(name) || domain.is_sliding(name)) continue;
    index[id] = names.size();
    names.push_back(name);
    condition.push_back(conditions.at(name));
    has_open_side = has_open_side || gives_pressure(condition.back().type);
  }

  constexpr int n = Space::n, n_q = Space::n_q;
  const dealii::QGauss<dim - 1> rule(degree + 1);
  dealii::FEFaceValues<dim> values(domain.mapping(), s.fe, rule,
                                   dealii::update_values | dealii::update_JxW_values |
                                       dealii::update_quadrature_points | dealii::update_normal_vectors);
  const dealii::QGauss<dim> cell_rule(degree + 1);
  const dealii::FE_DGQArbitraryNodes<dim> at_points{dealii::QGauss<1>(degree + 1)};
  const auto& partitioner = *s.structure->partitioner;
  const auto& support = s.fe.get_unit_support_points();
  const std::size_t n_local = s.constrained.size();

  // Which side decides each component of each node, and the pressure.
  std::array<std::vector<int>, dim> chosen;
  for (auto& c : chosen) c.assign(n_local, -1);
  std::vector<int> chosen_pressure(n_local, -1);
  std::vector<dealii::Point<dim>> position(n_local);
  std::vector<dealii::types::global_dof_index> ids(n);
  std::uint32_t cell_number = 0;
  std::map<std::pair<std::uint32_t, int>, Vector> sums;
  for (const auto& cell : s.dofs.active_cell_iterators()) {
    if (cell->is_artificial()) continue;
    const bool owned = cell->is_locally_owned();
    const std::uint32_t number = owned ? cell_number++ : 0;
    if (!cell->at_boundary()) continue;
    cell->get_dof_indices(ids);
    const bool turns = has_rotor && cell->material_id() == rotor.material;
    for (const unsigned int f : cell->face_indices()) {
      if (!cell->face(f)->at_boundary()) continue;
      const auto found = index.find(cell->face(f)->boundary_id());
      if (found == index.end()) continue;  // periodic or sliding
      const int side = found->second;
      const BoundaryType type = condition[side].type;
      values.reinit(cell, f);
      int axis = 0;
      for (int d = 1; d < dim; ++d)
        if (std::abs(values.normal_vector(0)[d]) > std::abs(values.normal_vector(0)[axis])) axis = d;
      if (type == BoundaryType::slip || type == BoundaryType::pressure_inlet)
        for (unsigned int q = 0; q < rule.size(); ++q)
          if (std::abs(values.normal_vector(q)[axis]) < 1 - 1e-9)
            throw InputError("Air/Boundary conditions: side \"" + names[side] +
                             "\" is not perpendicular to an axis; " +
                             "slip and pressure inlet need that. Use a wall, or turn the mesh.");
      for (int i = 0; i < n; ++i) {
        if (!s.fe.has_support_on_face(i, f)) continue;
        if (!owned && !partitioner.in_local_range(ids[i]) && !partitioner.is_ghost_entry(ids[i])) continue;
        const std::uint32_t node = partitioner.global_to_local(ids[i]);
        node_turns[node] = turns;
        position[node] = domain.mapping().transform_unit_to_real_cell(cell, support[i]);
        for (int d = 0; d < dim; ++d) {
          const bool decides = gives_velocity(type) || (type == BoundaryType::slip && d == axis) ||
                               (type == BoundaryType::pressure_inlet && d != axis);
          if (decides && (chosen[d][node] < 0 || rank_of(type) < rank_of(condition[chosen[d][node]].type)))
            chosen[d][node] = side;
        }
        if (gives_pressure(type)) chosen_pressure[node] = side;
      }
      if (!owned) continue;
      Face face;
      face.place = s.place[number];
      face.side = side;
      for (unsigned int q = 0; q < rule.size(); ++q) {
        const auto point = domain.mapping().transform_real_to_unit_cell(cell, values.quadrature_point(q));
        face.normal.push_back(values.normal_vector(q) * values.JxW(q));
        if (turns) face.position.push_back(values.quadrature_point(q));
        for (int i = 0; i < n; ++i) {
          face.value.push_back(values.shape_value(i, q));
          sums[{partitioner.global_to_local(ids[i]), side}] += values.shape_value(i, q) * face.normal.back();
        }
        int nearest = 0;
        for (int k = 0; k < n_q; ++k) {
          face.extrapolate.push_back(at_points.shape_value(k, point));
          if (cell_rule.point(k).distance(point) < cell_rule.point(nearest).distance(point)) nearest = k;
        }
        face.nearest.push_back(nearest);
      }
      face.turns = turns;
      // A wall that stands lets nothing through; along a part of the mesh that turns, it moves relative to
      // it.
      if (gives_velocity(type) && (type != BoundaryType::wall || turns)) faces.push_back(std::move(face));
    }
  }
  for (const auto& [key, normal] : sums)
    if (normal.norm() > 0)
      normals.push_back({key.first, key.second, normal, node_turns[key.first] > 0, position[key.first]});

  const std::uint32_t n_owned = partitioner.locally_owned_size();
  NodalVector flag;
  s.initialize(flag);
  const auto mark = [&](const std::vector<int>& side_of, std::vector<Node>& nodes, std::vector<char>& fixed) {
    flag = 0;
    for (std::uint32_t i = 0; i < n_owned; ++i) {
      if (side_of[i] >= 0 && !s.constrained[i])
        nodes.push_back({i, side_of[i], position[i], node_turns[i] > 0});
      if (side_of[i] >= 0 || s.constrained[i]) flag.local_element(i) = 1;
    }
    flag.update_ghost_values();
    for (std::uint32_t i = 0; i < n_local; ++i) fixed.push_back(flag.local_element(i) > 0);
    flag.zero_out_ghost_values();
  };
  for (int d = 0; d < dim; ++d) mark(chosen[d], fixed_velocity[d], velocity_fixed[d]);
  mark(chosen_pressure, fixed_pressure, pressure_fixed);
}

template <int dim, int degree>
template <typename Visit>
void BoundaryData<dim, degree>::visit_turning(const Visit& visit) {
  Vector none;
  for (auto* list : {&fixed_pressure})
    for (Node& node : *list)
      if (node.turns) visit(node.position, none);
  for (auto& list : fixed_velocity)
    for (Node& node : list)
      if (node.turns) visit(node.position, none);
  for (NodeNormal& n : normals)
    if (n.turns) visit(n.position, n.normal);
  for (Face& face : faces)
    for (std::size_t q = 0; face.turns && q < face.normal.size(); ++q)
      visit(face.position[q], face.normal[q]);
}

template <int dim, int degree>
void BoundaryData<dim, degree>::turn_to(const Rotor<dim>& r, double angle) {
  if (points_at_rest.empty())
    visit_turning([&](const dealii::Point<dim>& x, const Vector& v) {
      points_at_rest.push_back(x);
      vectors_at_rest.push_back(v);
    });
  const auto rotation = r.rotation(angle);
  std::size_t k = 0;
  visit_turning([&](dealii::Point<dim>& x, Vector& v) {
    x = angle == 0 ? points_at_rest[k] : r.centre + rotation * (points_at_rest[k] - r.centre);
    v = angle == 0 ? vectors_at_rest[k] : rotation * vectors_at_rest[k];
    ++k;
  });
}

template <int dim, int degree>
void BoundaryData<dim, degree>::set_velocity(double time, std::array<NodalVector, dim>& u,
                                             double factor) const {
  for (int d = 0; d < dim; ++d)
    for (const Node& node : fixed_velocity[d]) {
      const auto& c = condition[node.side];
      const bool given = c.type == BoundaryType::moving_wall || c.type == BoundaryType::velocity_inlet;
      double& value = u[d].local_element(node.node);
      value = given ? factor * c.velocity(node.position, time)[d] : 0.0;
      if (c.type == BoundaryType::rotor_wall)
        value = factor * rotor.velocity(node.position, turning_speed)[d];
    }
}

template <int dim, int degree>
void BoundaryData<dim, degree>::set_pressure(double time, NodalVector& p) const {
  for (const Node& node : fixed_pressure)
    p.local_element(node.node) = condition[node.side].pressure(node.position, time);
}

template <int dim, int degree>
double BoundaryData<dim, degree>::subtract_flux(const std::array<NodalVector, dim>& u,
                                                const PointField& void_fraction, NodalVector& y,
                                                std::vector<double>* outflow) const {
  constexpr int n = Space::n, n_q = Space::n_q, W = Space::W;
  double inflow = 0;
  for (const Face& face : faces) {
    const std::size_t group = face.place / W, lane = face.place % W;
    double contribution[n] = {};
    for (std::size_t q = 0; q < face.normal.size(); ++q) {
      Vector velocity;
      for (int i = 0; i < n; ++i)
        for (int d = 0; d < dim; ++d)
          velocity[d] += face.value[q * n + i] * u[d].local_element(space.node[(group * n + i) * W + lane]);
      if (face.turns) velocity -= rotor.velocity(face.position[q], turning_speed);
      double eps = 0;
      for (int k = 0; k < n_q; ++k)
        eps += face.extrapolate[q * n_q + k] * void_fraction[group * n_q + k][lane];
      if (!(eps > 0 && eps <= 1)) eps = void_fraction[group * n_q + face.nearest[q]][lane];
      const double flux = eps * (velocity * face.normal[q]);
      if (outflow) (*outflow)[face.side] += flux;
      inflow += std::max(0.0, -flux);
      for (int i = 0; i < n; ++i) contribution[i] -= flux * face.value[q * n + i];
    }
    space.add(contribution, face.place, y);
  }
  return inflow;
}

template <int dim, int degree>
std::vector<dealii::Tensor<1, dim>> BoundaryData<dim, degree>::pressure_force(const NodalVector& p) const {
  std::vector<Vector> force(names.size());
  for (const auto& b : normals) force[b.side] -= p.local_element(b.node) * b.normal;
  return force;
}

template <int dim, int degree>
std::vector<double> BoundaryData<dim, degree>::turning_moment() const {
  std::vector<double> moment(names.size(), 0.0);
  for (const auto& b : normals)
    if (condition[b.side].type == BoundaryType::rotor_wall)
      moment[b.side] += rotor.across(b.position - rotor.centre) * rotor.across(b.normal);
  return moment;
}

template class BoundaryData<2, 1>;
template class BoundaryData<3, 1>;
template class BoundaryData<2, 2>;
template class BoundaryData<3, 2>;

}  // namespace seedflow
