#include <algorithm>
#include <cmath>

#include "seedflow/fluid/sliding_coupling.h"

namespace seedflow {

/// eps v at the Gauss points of a face, extrapolated across the cell; v from share() with dim + 1 components.
template <int dim, int degree>
std::array<dealii::Tensor<1, dim>, SlidingCoupling<dim, degree>::n_face> SlidingCoupling<dim, degree>::trace(
    std::uint32_t face, const std::vector<double>& v) const {
  const unsigned int number = faces->faces()[face].number;
  const double* from = v.data() + std::size_t(cell_of_face[face]) * n_q * (dim + 1);
  std::array<Vector, n_face> result;
  for (int a = 0; a < n_face; ++a)
    for (int b = 0; b < n_line; ++b) {
      const double* at = from + point_of_face[number][a * n_line + b] * (dim + 1);
      for (int d = 0; d < dim; ++d) result[a][d] += end_value[number % 2][b] * at[d];
    }
  return result;
}

/// The same for eps times the rotor's own velocity.
template <int dim, int degree>
std::array<dealii::Tensor<1, dim>, SlidingCoupling<dim, degree>::n_face>
SlidingCoupling<dim, degree>::trace_of_turning(std::uint32_t face, const Momentum& terms) const {
  const auto& rotor = faces->rotor_description();
  const auto& f = faces->faces()[face];
  const Cell& cell = cells[cell_of_face[face]];
  const double* from = terms.velocity.data() + std::size_t(cell_of_face[face]) * n_q * (dim + 1);
  std::array<Vector, n_face> result;
  for (int a = 0; a < n_face; ++a)
    for (int b = 0; b < n_line; ++b) {
      const int q = point_of_face[f.number][a * n_line + b];
      dealii::Point<dim> x;
      for (int v = 0; v < 1 << dim; ++v) x += linear_value[q][v] * cell.vertex[v];
      result[a] += end_value[f.number % 2][b] * from[q * (dim + 1) + dim] *
                   rotor.velocity(rotor.turned(x, faces->angle()), terms.turning_speed);
    }
  return result;
}

template <int dim, int degree>
void SlidingCoupling<dim, degree>::add_convection(std::uint32_t piece_number, const Momentum& terms,
                                                  double* local) const {
  const auto& piece = faces->pieces()[piece_number];
  const auto& all = faces->faces();
  const bool sliver = faces->on_cylinder(all[piece.face[0]]);
  std::array<Vector, n_face> carried[2], turning{};
  for (int side = 0; side < 2; ++side) carried[side] = trace(piece.face[side], terms.velocity);
  const bool relative = sliver && terms.turning_speed != 0;
  if (relative) turning = trace_of_turning(piece.face[0], terms);
  constexpr int m = 2 * n_face;
  for (auto q = piece.begin; q < piece.end; ++q) {
    const auto& point = faces->points()[q];
    FaceValues v[2];
    double flux = 0, mesh_flux = 0, along = 0;
    const Vector s = sliver ? sliver_flux(piece, point) : Vector();
    for (int side = 0; side < 2; ++side) {
      v[side] = face_values(piece.face[side], point.at[side]);
      const Vector& normal = frame[piece.face[side]].normal;
      for (int a = 0; a < n_face; ++a) {
        flux += (side == 0 ? 0.5 : -0.5) * v[side].test[a] * (carried[side][a] * normal);
        along += 0.5 * v[side].test[a] * (carried[side][a] * s);
        if (side == 0 && relative) mesh_flux += v[side].test[a] * (turning[a] * normal);
      }
    }
    flux *= terms.density * point.weight;
    along *= terms.density * point.weight;
    mesh_flux *= terms.density * point.weight;
    // Test and trial functions of both sides in a row: [v] = sum jump v_i, {u} = sum u_j / 2.
    for (int i = 0; i < m; ++i) {
      const int side = i / n_face, a = i % n_face;
      const double jump = (side == 0 ? 1 : -1) * v[side].node[a], slope = v[side].slope[a];
      for (int j = 0; j < m; ++j) {
        const int other = j / n_face, b = j % n_face;
        const double mean = 0.5 * v[other].node[b], upwind = (other == 0 ? 0.5 : -0.5) * v[other].node[b];
        double value = jump * (flux * mean + std::abs(flux) * upwind);
        if (sliver) value -= 0.5 * along * mean * slope;
        if (relative && side == 0) value -= mesh_flux * v[0].node[a] * mean;
        local[i * m + j] += value;
      }
    }
  }
}

template <int dim, int degree>
dealii::Tensor<1, dim> SlidingCoupling<dim, degree>::wall_velocity(std::uint32_t face, int corner,
                                                                   double speed) const {
  const auto& rotor = faces->rotor_description();
  const auto& f = faces->faces()[face];
  if (f.side == SlidingInterface<dim>::rotor && !rotor.pairs[f.pair].uncovered_rotor_turns) return Vector();
  dealii::Point<dim - 1> x;
  for (int a = 0; a < dim - 1; ++a) x[a] = line_node[a == 0 ? corner % n_line : corner / n_line];
  return rotor.velocity(faces->at(f, x).position, speed);
}

template <int dim, int degree>
typename SlidingCoupling<dim, degree>::Walls SlidingCoupling<dim, degree>::walls_of(
    std::uint32_t c, const Momentum& terms) const {
  const Cell& cell = cells[c];
  Walls walls;
  walls.lifted.assign(n_q * dim, Vector());
  for (const std::uint32_t f : cell.faces) {
    const auto& face = faces->faces()[f];
    if (face.uncovered() == 0) continue;
    const auto carried = trace(f, terms.velocity);
    double speed = 0;
    for (const Vector& w : carried) speed = std::max(speed, std::abs(w * frame[f].normal));
    for (int j = 0; j < n_face; ++j) {
      const Vector u = wall_velocity(f, j, terms.turning_speed);
      walls.nodes.push_back(
          {node_of_face[face.number][j], terms.density * speed * std::max(0.0, wall_area[f][j]), u});
      for (int a = 0; a < n_face; ++a)
        for (int b = 0; b < n_line; ++b)
          for (int d = 0; d < dim; ++d) {
            const int q = point_of_face[face.number][a * n_line + b];
            walls.lifted[q * dim + d] += frame[f].normal[d] * end_value[face.number % 2][b] *
                                         wall_moments[f][a * n_face + j] / cell.JxW[q] * u;
          }
    }
  }
  return walls;
}

template <int dim, int degree>
void SlidingCoupling<dim, degree>::add_momentum(const Momentum& terms, SparseMatrix& matrix,
                                                std::array<NodalVector, dim>& rhs) const {
  const std::uint32_t n_owned = space.structure->n_owned();
  std::vector<double> local, block(4 * n_face * n_face);
  for (std::uint32_t c = 0; c < cells.size(); ++c) {
    const Cell& cell = cells[c];
    if (!cell.needed) continue;
    const std::size_t m = cell.slot.size();
    diffusion_of(c, terms.diffusion.data() + c * n_q, true, local);
    if (cell.turns)
      for (const std::uint32_t f : cell.faces)
        for (const std::uint32_t p : pieces_of_face[f]) {
          std::fill(block.begin(), block.end(), 0.0);
          add_convection(p, terms, block.data());
          const auto masters = slots_of_piece(c, p);
          for (int i = 0; i < 2 * n_face; ++i)
            for (int j = 0; j < 2 * n_face; ++j)
              for (const auto& [a, wa] : masters[i])
                for (const auto& [b, wb] : masters[j])
                  local[a * m + b] += wa * wb * block[i * 2 * n_face + j];
        }
    if (!cell.wall.empty()) {
      const Walls walls = walls_of(c, terms);
      // int c G(v).l with l the lifting of the wall's velocity, and the penalty.
      std::vector<double> h(m);
      for (int q = 0; q < n_q; ++q)
        for (int d = 0; d < dim; ++d) {
          if (!cell.lifts[d]) continue;
          discrete_gradient(cell, q, d, h);
          const Vector& l = walls.lifted[q * dim + d];
          const double factor = terms.diffusion[c * n_q + q] * cell.JxW[q];
          for (std::size_t s = 0; s < m; ++s)
            if (cell.slot[s] < n_owned)
              for (int e = 0; e < dim; ++e) rhs[e].local_element(cell.slot[s]) -= factor * h[s] * l[e];
        }
      for (const auto& node : walls.nodes)
        for (std::uint32_t k = cell.first[node.i]; k < cell.first[node.i + 1]; ++k) {
          const double weighted = node.penalty * cell.weight[k];
          for (std::uint32_t l = cell.first[node.i]; l < cell.first[node.i + 1]; ++l)
            local[cell.own_slot[k] * m + cell.own_slot[l]] += weighted * cell.weight[l];
          if (cell.node[k] < n_owned)
            for (int e = 0; e < dim; ++e) rhs[e].local_element(cell.node[k]) += weighted * node.velocity[e];
        }
    }
    add_to_patch(c, local, matrix);
  }
}

/// G with walls of the slots' shape functions, component d at point q.
template <int dim, int degree>
void SlidingCoupling<dim, degree>::discrete_gradient(const Cell& cell, int q, int d,
                                                     std::vector<double>& h) const {
  gradient_on_slots(cell, q, d, h);
  const std::size_t m = cell.slot.size();
  for (std::size_t s = 0; s < m; ++s) {
    h[s] -= cell.lift[(q * dim + d) * m + s] / cell.JxW[q];
    if (!cell.wall.empty()) h[s] -= cell.wall[(q * dim + d) * m + s] / cell.JxW[q];
  }
}

template <int dim, int degree>
std::array<dealii::Tensor<1, dim>, 2> SlidingCoupling<dim, degree>::wall_force(
    const Momentum& terms, const std::array<NodalVector, dim>& u) const {
  std::array<Vector, 2> force;
  std::vector<double> h;
  for (std::uint32_t c = 0; c < cells.size(); ++c) {
    const Cell& cell = cells[c];
    if (cell.place < 0) continue;
    Vector& sum = force[cell.turns ? 0 : 1];
    const std::size_t m = cell.slot.size();
    if (cell.turns && terms.turning_speed != 0) sum += mesh_momentum(c, terms, u);
    if (cell.wall.empty()) continue;
    const Walls walls = walls_of(c, terms);
    h.resize(m);
    for (int q = 0; q < n_q; ++q)
      for (int d = 0; d < dim; ++d) {
        if (!cell.lifts[d]) continue;
        discrete_gradient(cell, q, d, h);
        Vector g = walls.lifted[q * dim + d];
        double one = 0;
        for (std::size_t s = 0; s < m; ++s) {
          one += cell.wall[(q * dim + d) * m + s] / cell.JxW[q];
          for (int e = 0; e < dim; ++e) g[e] += h[s] * u[e].local_element(cell.slot[s]);
        }
        sum += terms.diffusion[c * n_q + q] * cell.JxW[q] * one * g;
      }
    for (const auto& node : walls.nodes)
      for (int e = 0; e < dim; ++e) {
        double value = -node.velocity[e];
        for (std::uint32_t k = cell.first[node.i]; k < cell.first[node.i + 1]; ++k)
          value += cell.weight[k] * u[e].local_element(cell.node[k]);
        sum[e] -= node.penalty * value;
      }
  }
  return force;
}

/// rho times the integral of eps u (w_mesh.n) over the chords of a cell: zero but for their not being arcs.
template <int dim, int degree>
dealii::Tensor<1, dim> SlidingCoupling<dim, degree>::mesh_momentum(
    std::uint32_t c, const Momentum& terms, const std::array<NodalVector, dim>& u) const {
  Vector sum;
  for (const std::uint32_t f : cells[c].faces) {
    if (!faces->on_cylinder(faces->faces()[f])) continue;
    const auto turning = trace_of_turning(f, terms);
    for (const std::uint32_t p : pieces_of_face[f]) {
      const auto& piece = faces->pieces()[p];
      const auto masters = slots_of_piece(c, p);
      for (auto q = piece.begin; q < piece.end; ++q) {
        const auto& point = faces->points()[q];
        double flux = 0;
        for (int side = 0; side < 2; ++side) {
          const FaceValues v = face_values(piece.face[side], point.at[side]);
          if (side == 0)
            for (int a = 0; a < n_face; ++a)
              flux += terms.density * point.weight * v.test[a] * (turning[a] * frame[f].normal);
          for (int j = 0; j < n_face; ++j)
            for (const auto& [s, weight] : masters[side * n_face + j])
              for (int e = 0; e < dim; ++e)
                sum[e] += flux * 0.5 * v.node[j] * weight * u[e].local_element(cells[c].slot[s]);
        }
      }
    }
  }
  return sum;
}

template <int dim, int degree>
std::array<std::vector<std::pair<std::uint32_t, double>>, 2 * SlidingCoupling<dim, degree>::n_face>
SlidingCoupling<dim, degree>::slots_of_piece(std::uint32_t c, std::uint32_t p) const {
  const Cell& cell = cells[c];
  std::array<std::vector<std::pair<std::uint32_t, double>>, 2 * n_face> result;
  const auto& piece = faces->pieces()[p];
  for (int side = 0; side < 2; ++side) {
    const Cell& from = cells[cell_of_face[piece.face[side]]];
    const unsigned int number = faces->faces()[piece.face[side]].number;
    for (int j = 0; j < n_face; ++j) {
      const int i = node_of_face[number][j];
      for (std::uint32_t k = from.first[i]; k < from.first[i + 1]; ++k)
        result[side * n_face + j].emplace_back(
            &from == &cell ? cell.own_slot[k]
                           : std::find(cell.slot.begin(), cell.slot.end(), from.node[k]) - cell.slot.begin(),
            from.weight[k]);
    }
  }
  return result;
}

template <int dim, int degree>
std::array<dealii::Tensor<1, dim>, 2> SlidingCoupling<dim, degree>::wall_pressure(
    const NodalVector& p) const {
  std::array<Vector, 2> force;
  for (const Cell& cell : cells) {
    if (cell.place < 0) continue;
    for (const std::uint32_t f : cell.faces)
      for (int j = 0; j < n_face; ++j) {
        const int i = node_of_face[faces->faces()[f].number][j];
        for (std::uint32_t k = cell.first[i]; k < cell.first[i + 1]; ++k)
          force[cell.turns ? 0 : 1] -=
              wall_area[f][j] * cell.weight[k] * p.local_element(cell.node[k]) * frame[f].normal;
      }
  }
  return force;
}

template <int dim, int degree>
void SlidingCoupling<dim, degree>::subtract_mesh_flux(const PointField& eps, double speed,
                                                      NodalVector& y) const {
  bool chords = false;
  for (const auto& f : faces->faces()) chords = chords || faces->on_cylinder(f);
  if (speed == 0 || !chords) return;
  Momentum terms{1, speed, {}, {}};
  terms.velocity = share(dim + 1, [&](std::size_t k, int lane, int) { return eps[k][lane]; });
  for (std::uint32_t c = 0; c < cells.size(); ++c) {
    const Cell& cell = cells[c];
    if (cell.place < 0 || !cell.turns) continue;
    for (const std::uint32_t f : cell.faces) {
      if (!faces->on_cylinder(faces->faces()[f])) continue;
      const auto turning = trace_of_turning(f, terms);
      for (const std::uint32_t p : pieces_of_face[f])
        for (auto q = faces->pieces()[p].begin; q < faces->pieces()[p].end; ++q) {
          const FaceValues v = face_values(f, faces->points()[q].at[0]);
          double flux = 0;
          for (int a = 0; a < n_face; ++a)
            flux += faces->points()[q].weight * v.test[a] * (turning[a] * frame[f].normal);
          for (int j = 0; j < n_face; ++j) {
            const int i = node_of_face[faces->faces()[f].number][j];
            for (std::uint32_t k = cell.first[i]; k < cell.first[i + 1]; ++k)
              y.local_element(cell.node[k]) += flux * v.node[j] * cell.weight[k];
          }
        }
    }
  }
}

#define SEEDFLOW_SLIDING_MOMENTUM(dim, degree)                                                            \
  template void SlidingCoupling<dim, degree>::add_momentum(const Momentum&, SparseMatrix&,                \
                                                           std::array<NodalVector, dim>&) const;          \
  template std::array<dealii::Tensor<1, dim>, 2> SlidingCoupling<dim, degree>::wall_force(                \
      const Momentum&, const std::array<NodalVector, dim>&) const;                                        \
  template std::array<dealii::Tensor<1, dim>, 2> SlidingCoupling<dim, degree>::wall_pressure(             \
      const NodalVector&) const;                                                                          \
  template void SlidingCoupling<dim, degree>::subtract_mesh_flux(const PointField&, double, NodalVector&) \
      const;
SEEDFLOW_SLIDING_MOMENTUM(2, 1)
SEEDFLOW_SLIDING_MOMENTUM(3, 1)
SEEDFLOW_SLIDING_MOMENTUM(2, 2)
SEEDFLOW_SLIDING_MOMENTUM(3, 2)

}  // namespace seedflow
