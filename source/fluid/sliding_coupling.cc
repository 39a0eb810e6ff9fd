#include "seedflow/fluid/sliding_coupling.h"

#include <deal.II/fe/fe_tools.h>

#include <algorithm>
#include <cmath>

namespace seedflow {

namespace {

/// Values (and derivatives) at x of the Lagrange polynomials of some nodes.
template <std::size_t m>
void lagrange(const std::array<double, m>& node, double x, double* value, double* slope) {
  for (std::size_t i = 0; i < m; ++i) {
    double v = 1, s = 0;
    for (std::size_t j = 0; j < m; ++j) {
      if (j == i) continue;
      const double c = 1 / (node[i] - node[j]);
      s = s * (x - node[j]) * c + v * c;
      v *= (x - node[j]) * c;
    }
    value[i] = v;
    if (slope) slope[i] = s;
  }
}

}  // namespace

template <int dim, int degree>
SlidingCoupling<dim, degree>::SlidingCoupling(const Space& s, const Domain<dim>& domain)
    : space(s), faces(std::make_unique<SlidingInterface<dim>>(domain, degree)) {
  const dealii::QGauss<1> rule(n_line);
  for (int i = 0; i < n_line; ++i) {
    line_node[i] = double(i) / degree;
    line_gauss[i] = rule.point(i)[0];
  }
  for (int end = 0; end < 2; ++end) lagrange(line_gauss, end, end_value[end].data(), nullptr);
  const auto shape_function = dealii::FETools::lexicographic_to_hierarchic_numbering<dim>(degree);
  int stride[3] = {1, n_line, n_line * n_line};
  for (int f = 0; f < 2 * dim; ++f) {
    const auto along = SlidingInterface<dim>::directions(f);
    for (int a = 0; a < n_face; ++a) {
      const int base =
          (a % n_line) * stride[along[0]] + (dim == 3 ? (a / n_line) * stride[along[dim - 2]] : 0);
      node_of_face[f][a] = shape_function[base + (f % 2) * degree * stride[f / 2]];
      for (int b = 0; b < n_line; ++b) point_of_face[f][a * n_line + b] = base + b * stride[f / 2];
    }
  }
  gather(domain);
}

template <int dim, int degree>
void SlidingCoupling<dim, degree>::gather(const Domain<dim>& domain) {
  const MPI_Comm comm = domain.communicator();
  const unsigned int rank = dealii::Utilities::MPI::this_mpi_process(comm);
  const auto& partitioner = *space.structure->partitioner;
  // One cell may have several faces at the interface; they follow one another in the list of faces.
  const auto& all = faces->faces();
  first_of_rank.assign(dealii::Utilities::MPI::n_mpi_processes(comm) + 1, 0);
  for (std::uint32_t f = 0; f < all.size(); ++f) {
    if (f == 0 || all[f].owner != all[f - 1].owner || all[f].cell != all[f - 1].cell) {
      cells.emplace_back();
      cells.back().turns = all[f].side == SlidingInterface<dim>::rotor;
      cells.back().vertex = all[f].vertex;
      if (all[f].owner == rank) cells.back().place = space.place[all[f].cell];
      ++first_of_rank[all[f].owner + 1];
    }
    cells.back().faces.push_back(f);
    cell_of_face.push_back(cells.size() - 1);
  }
  for (std::size_t r = 1; r < first_of_rank.size(); ++r) first_of_rank[r] += first_of_rank[r - 1];

  // Masters of every cell's nodes: per shape function their number, then pairs of global number and weight.
  std::vector<double> mine;
  for (const Cell& cell : cells) {
    if (cell.place < 0) continue;
    for (int i = 0; i < n; ++i) {
      const auto masters = space.masters(cell.place, i);
      mine.push_back(masters.size());
      for (const auto& [node, weight] : masters) {
        mine.push_back(partitioner.local_to_global(node));
        mine.push_back(weight);
      }
    }
  }
  const auto everyone = dealii::Utilities::MPI::all_gather(comm, mine);
  for (std::size_t r = 0; r < everyone.size(); ++r) {
    const double* next = everyone[r].data();
    for (int c = first_of_rank[r]; c < first_of_rank[r + 1]; ++c) {
      Cell& cell = cells[c];
      cell.first.push_back(0);
      for (int i = 0; i < n; ++i) {
        for (int k = int(*next++); k > 0; --k, next += 2) {
          const std::uint32_t node = partitioner.global_to_local(dealii::types::global_dof_index(next[0]));
          const auto found = std::find(cell.slot.begin(), cell.slot.end(), node);
          cell.own_slot.push_back(found - cell.slot.begin());
          if (found == cell.slot.end()) cell.slot.push_back(node);
          cell.node.push_back(node);
          cell.weight.push_back(next[1]);
        }
        cell.first.push_back(cell.node.size());
      }
    }
  }

  // Geometry of the multilinear map.
  const dealii::FE_Q<dim> linear(1);
  const dealii::QGauss<dim> rule(n_line);
  for (int q = 0; q < n_q; ++q)
    for (int v = 0; v < 1 << dim; ++v) linear_value[q][v] = linear.shape_value(v, rule.point(q));
  for (Cell& cell : cells) {
    cell.gradient.resize(n_q * dim * n);
    for (int q = 0; q < n_q; ++q) {
      dealii::Tensor<2, dim> jacobian;
      for (int v = 0; v < 1 << dim; ++v) {
        const auto slope = linear.shape_grad(v, rule.point(q));
        for (int d = 0; d < dim; ++d)
          for (int e = 0; e < dim; ++e) jacobian[d][e] += cell.vertex[v][d] * slope[e];
      }
      const auto inverse = dealii::invert(jacobian);
      cell.JxW[q] = dealii::determinant(jacobian) * rule.weight(q);
      for (int i = 0; i < n; ++i)
        for (int d = 0; d < dim; ++d) {
          double g = 0;
          for (int e = 0; e < dim; ++e) g += space.shape.test[q][1 + e][i] * inverse[e][d];
          cell.gradient[(q * dim + d) * n + i] = g;
        }
    }
  }
}

template <int dim, int degree>
typename SlidingCoupling<dim, degree>::FaceValues SlidingCoupling<dim, degree>::face_values(
    std::uint32_t face, const dealii::Point<dim - 1>& x) const {
  double test[2][n_line], node[2][n_line], slope[2][n_line];
  for (int a = 0; a < dim - 1; ++a) {
    lagrange(line_gauss, x[a], test[a], nullptr);
    lagrange(line_node, x[a], node[a], slope[a]);
  }
  const auto& arc = frame[face].arc;
  FaceValues v;
  for (int i = 0; i < n_face; ++i) {
    const int i0 = i % n_line, i1 = i / n_line;
    v.test[i] = test[0][i0];
    v.node[i] = node[0][i0];
    v.slope[i] = arc[0] * slope[0][i0];
    if constexpr (dim == 3) {
      v.test[i] *= test[1][i1];
      v.node[i] *= node[1][i1];
      v.slope[i] = v.slope[i] * node[1][i1] + arc[1] * node[0][i0] * slope[1][i1];
    }
    v.node[i] += correction[face][i];
  }
  return v;
}

template <int dim, int degree>
void SlidingCoupling<dim, degree>::set_corrections() {
  const auto& all = faces->faces();
  correction.assign(all.size(), {});
  std::vector<std::array<double, n_face>> left(all.size());
  std::vector<double> weight;
  for (std::uint32_t f = 0; f < all.size(); ++f) {
    left[f] = {};
    faces->gauss_weights(all[f], weight);
    for (std::size_t q = 0; q < weight.size(); ++q) {
      const FaceValues v = face_values(f, faces->gauss_points()[q]);
      for (int i = 0; i < n_face; ++i) left[f][i] += weight[q] * v.node[i];
    }
  }
  for (const auto& piece : faces->pieces())
    for (auto q = piece.begin; q < piece.end; ++q)
      for (int side = 0; side < 2; ++side) {
        const std::uint32_t f = piece.face[side];
        const FaceValues v = face_values(f, faces->points()[q].at[side]);
        for (int i = 0; i < n_face; ++i) left[f][i] -= faces->points()[q].weight * v.node[i];
      }
  for (std::uint32_t f = 0; f < all.size(); ++f)
    if (all[f].uncovered() == 0)
      for (int i = 0; i < n_face; ++i) correction[f][i] = left[f][i] / all[f].area;
}

template <int dim, int degree>
void SlidingCoupling<dim, degree>::turn_to(double angle) {
  faces->turn_to(angle);
  rotation = faces->rotor_description().rotation(angle);
  const auto& all = faces->faces();
  frame.resize(all.size());
  dealii::Point<dim - 1> centre;
  for (int a = 0; a < dim - 1; ++a) centre[a] = 0.5;
  for (std::uint32_t f = 0; f < all.size(); ++f) frame[f] = faces->at(all[f], centre);
  set_corrections();
  pieces_of_face.assign(all.size(), {});
  for (std::uint32_t p = 0; p < faces->pieces().size(); ++p)
    for (const auto f : faces->pieces()[p].face) pieces_of_face[f].push_back(p);
  compute_moments();
  wall_area.assign(all.size(), {});
  wall_moments.assign(all.size(), {});
  for (Cell& cell : cells) {
    compute_lifting(cell);
    compute_walls(cell);
  }
  build_patch();
}

template <int dim, int degree>
void SlidingCoupling<dim, degree>::compute_moments() {
  const auto& all = faces->faces();
  moments.assign(faces->pieces().size(), {});
  for (std::size_t p = 0; p < moments.size(); ++p) {
    const auto& piece = faces->pieces()[p];
    const bool sliver = faces->on_cylinder(all[piece.face[0]]);
    PieceMoments& m = moments[p];
    for (auto q = piece.begin; q < piece.end; ++q) {
      const auto& point = faces->points()[q];
      const FaceValues v[2] = {face_values(piece.face[0], point.at[0]),
                               face_values(piece.face[1], point.at[1])};
      for (int side = 0; side < 2; ++side)
        for (int a = 0; a < n_face; ++a) {
          const double t = point.weight * v[side].test[a];
          for (int i = 0; i < n_face; ++i) {
            m.own[side][a * n_face + i] += t * v[side].node[i];
            m.other[side][a * n_face + i] += t * v[1 - side].node[i];
          }
        }
      if (!sliver) continue;
      const Vector s = sliver_flux(piece, point);
      for (int side = 0; side < 2; ++side)
        for (int a = 0; a < n_face; ++a)
          for (int d = 0; d < dim; ++d) {
            const double t = point.weight * v[side].test[a] * s[d];
            for (int i = 0; i < n_face; ++i) {
              m.sliver_own[side][d][a * n_face + i] += t * v[side].slope[i];
              m.sliver_other[side][d][a * n_face + i] += t * v[1 - side].slope[i];
            }
          }
    }
  }
}

/// s with psi = v.s: the flow of v along the sliver between the chords, per length along the axis.
template <int dim, int degree>
dealii::Tensor<1, dim> SlidingCoupling<dim, degree>::sliver_flux(
    const typename SlidingInterface<dim>::Piece& piece,
    const typename SlidingInterface<dim>::Point& point) const {
  const auto& all = faces->faces();
  const Vector gap = faces->at(all[piece.face[0]], point.at[0]).position -
                     faces->at(all[piece.face[1]], point.at[1]).position;
  const auto& rotor = faces->rotor_description();
  // Inside the cylinder the rotor's outward normal is radial; outside it is the opposite.
  const Vector radial = frame[piece.face[0]].position - rotor.centre;
  const double sign = frame[piece.face[0]].normal * radial > 0 ? -1 : 1;
  return sign * rotor.across(gap);
}

template <int dim, int degree>
void SlidingCoupling<dim, degree>::compute_lifting(Cell& cell) {
  const auto& all = faces->faces();
  const std::uint32_t n_own = *std::max_element(cell.own_slot.begin(), cell.own_slot.end()) + 1;
  cell.slot.resize(n_own);
  const auto slot_of = [&cell](std::uint32_t node) -> std::uint32_t {
    const auto found = std::find(cell.slot.begin(), cell.slot.end(), node);
    if (found == cell.slot.end()) {
      cell.slot.push_back(node);
      return cell.slot.size() - 1;
    }
    return found - cell.slot.begin();
  };
  // Number the nodes first, then add: [slot][q][d] grows with the slots.
  std::vector<std::array<double, n_q * dim>> lift(n_own);
  for (auto& l : lift) l = {};
  const auto add = [&](std::uint32_t slot, double weight, unsigned int number, int d, const double* column) {
    // column[a n_face]: over the Gauss points of the face
    if (slot >= lift.size()) lift.resize(slot + 1, {});
    const auto& points = point_of_face[number];
    const auto& end = end_value[number % 2];
    for (int a = 0; a < n_face; ++a)
      for (int b = 0; b < n_line; ++b)
        lift[slot][points[a * n_line + b] * dim + d] += weight * end[b] * column[a * n_face];
  };
  for (const std::uint32_t f : cell.faces) {
    const auto& face = all[f];
    const int side = face.side;
    const bool sliver = faces->on_cylinder(face);
    Moments own[dim];
    for (auto& m : own) m = {};
    for (const std::uint32_t p : pieces_of_face[f]) {
      const PieceMoments& m = moments[p];
      const std::uint32_t other_face = faces->pieces()[p].face[1 - side];
      const Cell& other = cells[cell_of_face[other_face]];
      for (int d = 0; d < dim; ++d) {
        const double normal = 0.5 * frame[f].normal[d];
        Moments remote;
        for (int k = 0; k < n_face * n_face; ++k) {
          own[d][k] += normal * m.own[side][k];
          remote[k] = -normal * m.other[side][k];
          if (sliver) {
            own[d][k] -= 0.25 * m.sliver_own[side][d][k];
            remote[k] -= 0.25 * m.sliver_other[side][d][k];
          }
        }
        if (normal == 0 && !sliver) continue;
        for (int j = 0; j < n_face; ++j) {
          const int i = node_of_face[all[other_face].number][j];
          for (std::uint32_t k = other.first[i]; k < other.first[i + 1]; ++k)
            add(slot_of(other.node[k]), other.weight[k], face.number, d, remote.data() + j);
        }
      }
    }
    for (int d = 0; d < dim; ++d)
      for (int j = 0; j < n_face; ++j) {
        const int i = node_of_face[face.number][j];
        for (std::uint32_t k = cell.first[i]; k < cell.first[i + 1]; ++k)
          add(cell.own_slot[k], cell.weight[k], face.number, d, own[d].data() + j);
      }
  }
  const std::size_t m = cell.slot.size();
  lift.resize(m, {});
  cell.lift.assign(n_q * dim * m, 0.0);
  cell.lifts.fill(false);
  for (std::size_t s = 0; s < m; ++s)
    for (int k = 0; k < n_q * dim; ++k) {
      cell.lift[k * m + s] = lift[s][k];
      if (lift[s][k] != 0) cell.lifts[k % dim] = true;
    }
}

template <int dim, int degree>
void SlidingCoupling<dim, degree>::compute_walls(Cell& cell) {
  cell.wall.clear();
  const std::size_t m = cell.slot.size();
  std::vector<double> weight;
  for (const std::uint32_t f : cell.faces) {
    const auto& face = faces->faces()[f];
    if (face.uncovered() == 0) continue;
    if (cell.wall.empty()) cell.wall.assign(n_q * dim * m, 0.0);
    // The whole face less its pieces.
    Moments& rest = wall_moments[f];
    faces->gauss_weights(face, weight);
    for (std::size_t q = 0; q < weight.size(); ++q) {
      const FaceValues v = face_values(f, faces->gauss_points()[q]);
      for (int a = 0; a < n_face; ++a)
        for (int i = 0; i < n_face; ++i) rest[a * n_face + i] += weight[q] * v.test[a] * v.node[i];
    }
    for (const std::uint32_t p : pieces_of_face[f])
      for (int k = 0; k < n_face * n_face; ++k) rest[k] -= moments[p].own[face.side][k];
    for (int j = 0; j < n_face; ++j) {
      const int i = node_of_face[face.number][j];
      for (int a = 0; a < n_face; ++a) wall_area[f][j] += rest[a * n_face + j];
      for (std::uint32_t k = cell.first[i]; k < cell.first[i + 1]; ++k)
        for (int a = 0; a < n_face; ++a)
          for (int b = 0; b < n_line; ++b)
            for (int d = 0; d < dim; ++d)
              cell.wall[(point_of_face[face.number][a * n_line + b] * dim + d) * m + cell.own_slot[k]] +=
                  cell.weight[k] * frame[f].normal[d] * end_value[face.number % 2][b] * rest[a * n_face + j];
    }
  }
  for (int d = 0; d < dim && !cell.wall.empty(); ++d)
    for (int q = 0; q < n_q && !cell.lifts[d]; ++q)
      for (std::size_t s = 0; s < m; ++s)
        cell.lifts[d] = cell.lifts[d] || cell.wall[(q * dim + d) * m + s] != 0;
}

template <int dim, int degree>
void SlidingCoupling<dim, degree>::build_patch() {
  const std::uint32_t n_owned = space.structure->n_owned(), n_local = space.constrained.size();
  std::vector<std::vector<std::pair<std::uint32_t, std::uint32_t>>> cells_of_row;
  auto s = std::make_shared<PatchStructure>();
  s->index.assign(n_owned, -1);
  for (std::uint32_t c = 0; c < cells.size(); ++c) {
    Cell& cell = cells[c];
    cell.needed = false;
    for (std::uint32_t a = 0; a < cell.slot.size(); ++a) {
      const std::uint32_t row = cell.slot[a];
      if (row >= n_owned) continue;
      cell.needed = true;
      if (s->index[row] < 0) {
        s->index[row] = s->row.size();
        s->row.push_back(row);
        cells_of_row.emplace_back();
      }
      cells_of_row[s->index[row]].emplace_back(c, a);
    }
    if (cell.needed) cell.position.assign(cell.slot.size() * cell.slot.size(), 0);
  }
  std::vector<std::int32_t> at(n_local, -1);
  for (std::uint32_t r = 0; r < s->row.size(); ++r) {
    const std::uint32_t begin = s->column.size();
    for (const auto& [c, a] : cells_of_row[r]) {
      Cell& cell = cells[c];
      const std::size_t m = cell.slot.size();
      for (std::size_t b = 0; b < m; ++b) {
        std::int32_t& place = at[cell.slot[b]];
        if (place < 0) {
          place = s->column.size();
          s->column.push_back(cell.slot[b]);
        }
        cell.position[a * m + b] = place;
      }
    }
    s->diagonal.push_back(at[s->row[r]]);
    for (std::uint32_t k = begin; k < s->column.size(); ++k) at[s->column[k]] = -1;
    s->start.push_back(s->column.size());
  }
  places = s;
}

template class SlidingCoupling<2, 1>;
template class SlidingCoupling<3, 1>;
template class SlidingCoupling<2, 2>;
template class SlidingCoupling<3, 2>;

}  // namespace seedflow
