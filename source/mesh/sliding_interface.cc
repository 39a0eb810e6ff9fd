#include "seedflow/mesh/sliding_interface.h"

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "seedflow/base/error.h"
#include "sliding_polygon.h"

namespace seedflow {

template <int dim>
dealii::Point<dim> SlidingInterface<dim>::in_cell(unsigned int number,
                                                  const dealii::Point<dim - 1>& reference) {
  dealii::Point<dim> x;
  x[number / 2] = number % 2;
  const auto d = directions(number);
  for (int a = 0; a < dim - 1; ++a) x[d[a]] = reference[a];
  return x;
}

template <int dim>
std::array<int, 2> SlidingInterface<dim>::directions(unsigned int number) {
  const int across = number / 2;
  if (dim == 2) return {1 - across, -1};
  return {across == 0 ? 1 : 0, across == 2 ? 1 : 2};
}

template <int dim>
int SlidingInterface<dim>::vertex_at(unsigned int number, int corner) {
  const auto d = directions(number);
  int v = (number % 2) << (number / 2);
  for (int a = 0; a < dim - 1; ++a) v |= ((corner >> a) & 1) << d[a];
  return v;
}

template <int dim>
SlidingInterface<dim>::SlidingInterface(const Domain<dim>& domain, int degree)
    : description(*domain.rotor()), gauss(), gauss_weight() {
  const dealii::Tensor<1, 3> a = dim == 3 ? description.direction() : Rotor<dim>::z_axis();
  int smallest = 0;
  for (int d = 1; d < 3; ++d)
    if (std::abs(a[d]) < std::abs(a[smallest])) smallest = d;
  dealii::Tensor<1, 3> e;
  e[smallest] = 1;
  e -= (e * a) * a;
  basis[0] = e / e.norm();
  basis[1] = dealii::cross_product_3d(a, basis[0]);
  if constexpr (dim == 2) {
    for (int i = 0; i < 2; ++i) basis[i] = dealii::Tensor<1, 3>();
    basis[0][0] = basis[1][1] = 1;
  }

  const dealii::QGauss<dim - 1> rule(degree + 2);
  gauss = rule.get_points();
  gauss_weight = rule.get_weights();
  // Collapsed to a triangle: exact to degree 2 n - 2, products of two shape functions of a quadrilateral have
  // degree 4 k.
  const dealii::QGauss<1> line(2 * degree + 1);
  for (unsigned int i = 0; i < line.size(); ++i)
    for (unsigned int j = 0; j < line.size(); ++j) {
      const double s = line.point(i)[0], t = line.point(j)[0];
      triangle_point.emplace_back(s * (1 - t), s * t);
      triangle_weight.push_back(2 * line.weight(i) * line.weight(j) * s);
    }
  gather(domain);
  classify();
  for (std::size_t p = 0; p < description.pairs.size(); ++p) build_table(p);
  turn_to(domain.angle());
}

template <int dim>
void SlidingInterface<dim>::gather(const Domain<dim>& domain) {
  // Numbers of a face, one row each: side, pair, number, cell, then the vertices of the cell.
  constexpr int head = 4, row = head + n_vertices * dim;
  std::vector<double> mine;
  std::uint32_t cell_number = 0;
  const MPI_Comm comm = domain.communicator();
  std::map<dealii::types::boundary_id, std::pair<Side, int>> kind;
  for (std::size_t p = 0; p < description.pairs.size(); ++p) {
    kind[domain.side(description.pairs[p].rotor)] = {rotor, p};
    kind[domain.side(description.pairs[p].stator)] = {stator, p};
  }
  for (const auto& cell : domain.triangulation().active_cell_iterators()) {
    if (!cell->is_locally_owned()) continue;
    for (const unsigned int f : cell->face_indices()) {
      if (!cell->face(f)->at_boundary()) continue;
      const auto found = kind.find(cell->face(f)->boundary_id());
      if (found == kind.end()) continue;
      const bool turns = cell->material_id() == description.material;
      if (turns != (found->second.first == rotor))
        throw InputError("Side \"" + domain.sides().at(found->first) +
                         "\" of the sliding interface belongs to " +
                         (turns ? "the rotor, but is named as the stator's."
                                : "the stator, but is named as the rotor's.") +
                         " Exchange the names or mend the materials of the cells.");
      for (const double v :
           {double(found->second.first), double(found->second.second), double(f), double(cell_number)})
        mine.push_back(v);
      for (const unsigned int v : cell->vertex_indices()) {
        const auto x = turns && domain.angle() != 0 ? description.turned(cell->vertex(v), -domain.angle())
                                                    : cell->vertex(v);
        for (int d = 0; d < dim; ++d) mine.push_back(x[d]);
      }
    }
    ++cell_number;
  }
  const auto everyone = dealii::Utilities::MPI::all_gather(comm, mine);
  for (std::size_t r = 0; r < everyone.size(); ++r)
    for (const double* v = everyone[r].data(); v != everyone[r].data() + everyone[r].size(); v += row) {
      Face f{v[0] == 0 ? rotor : stator,   int(v[1]),           static_cast<unsigned int>(v[2]),
             static_cast<unsigned int>(r), std::uint32_t(v[3]), {}};
      for (int i = 0; i < n_vertices; ++i)
        for (int d = 0; d < dim; ++d) f.vertex[i][d] = v[head + i * dim + d];
      all.push_back(f);
    }
}

template <int dim>
void SlidingInterface<dim>::classify() {
  surfaces.resize(description.pairs.size());
  const dealii::Tensor<1, 3> axis = dim == 3 ? description.direction() : Rotor<dim>::z_axis();
  for (std::size_t p = 0; p < surfaces.size(); ++p) {
    const auto& names = description.pairs[p];
    double low[2][2] = {{1e300, 1e300}, {1e300, 1e300}}, high[2][2] = {{-1e300, -1e300}, {-1e300, -1e300}};
    double size = 0;
    for (const Face& f : all) {
      if (f.pair != int(p)) continue;
      for (int c = 0; c < n_corners; ++c) {
        const auto r = f.vertex[vertex_at(f.number, c)] - description.centre;
        double z = 0;
        if (dim == 3)
          for (int d = 0; d < dim; ++d) z += r[d] * axis[d];
        const double radius = std::sqrt(std::max(0.0, r.norm_square() - z * z)), value[2] = {z, radius};
        for (int k = 0; k < 2; ++k) {
          low[f.side][k] = std::min(low[f.side][k], value[k]);
          high[f.side][k] = std::max(high[f.side][k], value[k]);
        }
        size = std::max(size, r.norm());
      }
    }
    for (int s = 0; s < 2; ++s)
      if (low[s][0] > high[s][0])
        throw InputError("Sliding interface: side \"" + (s == rotor ? names.rotor : names.stator) +
                         "\" has no faces in the mesh.");
    const auto flat = [&](int k) {
      return std::max(high[rotor][k], high[stator][k]) - std::min(low[rotor][k], low[stator][k]) <
             1e-6 * size;
    };
    if (dim == 3 && flat(0)) {
      surfaces[p].position = low[rotor][0];
    } else if (flat(1)) {
      surfaces[p].radius = low[rotor][1];
    } else {
      std::ostringstream message;
      message << "Sliding interface: sides \"" << names.rotor << "\" and \"" << names.stator
              << "\" must lie in one plane across the axis or on one cylinder around it. Along the axis they "
                 "reach from "
              << low[rotor][0] << " to " << high[rotor][0] << " m and from " << low[stator][0] << " to "
              << high[stator][0] << " m; their distances from the axis from " << low[rotor][1] << " to "
              << high[rotor][1] << " m and from " << low[stator][1] << " to " << high[stator][1] << " m.";
      throw InputError(message.str());
    }
  }
  corner_at_rest.resize(all.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Surface& s = surfaces[all[i].pair];
    auto& c = corner_at_rest[i];
    for (int k = 0; k < n_corners; ++k) c[k] = parameter(s, all[i].vertex[vertex_at(all[i].number, k)]);
    if (s.radius > 0) {
      const double turn = 2 * pi * s.radius;
      for (int k = 1; k < n_corners; ++k) c[k][0] -= turn * std::round((c[k][0] - c[0][0]) / turn);
    }
    if constexpr (dim == 3) {
      std::vector<Corner> polygon;
      for (const int k : around) polygon.push_back(c[k]);
      const double area = std::abs(area_of(polygon)), tolerance = 1e-6 * std::sqrt(area);
      all[i].area = area;
      if (s.radius > 0) {
        // A rectangle: every edge keeps one parameter.
        for (int k = 0; k < 4; ++k) {
          const Corner &a = polygon[k], &b = polygon[(k + 1) % 4];
          if (std::min(std::abs(a[0] - b[0]), std::abs(a[1] - b[1])) > tolerance)
            throw InputError(
                "Sliding interface: a face on the cylinder of sides \"" +
                description.pairs[all[i].pair].rotor + "\" and \"" + description.pairs[all[i].pair].stator +
                "\" is not bounded by lines along and around the axis. Mesh the cylinder regularly.");
        }
      }
    } else {
      all[i].area = std::abs(c[1][0] - c[0][0]);
    }
  }
}

template <int dim>
Corner SlidingInterface<dim>::parameter(const Surface& s, const dealii::Point<dim>& x) const {
  double v[3] = {};
  const auto r = x - description.centre;
  for (int d = 0; d < dim; ++d) {
    v[0] += r[d] * basis[0][d];
    v[1] += r[d] * basis[1][d];
    if (dim == 3) v[2] += r[d] * description.direction()[d];
  }
  if (s.radius > 0) return {s.radius * std::atan2(v[1], v[0]), v[2]};
  return {v[0], v[1]};
}

template <int dim>
void SlidingInterface<dim>::build_table(int pair) {
  Surface& s = surfaces[pair];
  s.low = {1e300, 1e300};
  s.high = {-1e300, -1e300};
  double area = 0;
  int count = 0;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (all[i].pair == pair && all[i].side == stator) {
      for (const Corner& c : corner_at_rest[i])
        for (int k = 0; k < 2; ++k) {
          s.low[k] = std::min(s.low[k], c[k]);
          s.high[k] = std::max(s.high[k], c[k]);
        }
      area += all[i].area;
      ++count;
    }
  s.cell = dim == 3 ? std::sqrt(area / count) : area / count;
  for (int k = 0; k < 2; ++k) s.n[k] = std::clamp(int((s.high[k] - s.low[k]) / s.cell) + 1, 1, 4096);
  std::vector<std::vector<std::uint32_t>> bins(s.n[0] * s.n[1]);
  for (std::size_t i = 0; i < all.size(); ++i)
    if (all[i].pair == pair && all[i].side == stator) {
      int first[2], last[2];
      for (int k = 0; k < 2; ++k) {
        double a = 1e300, b = -1e300;
        for (const Corner& c : corner_at_rest[i]) {
          a = std::min(a, c[k]);
          b = std::max(b, c[k]);
        }
        first[k] = std::clamp(int((a - s.low[k]) / s.cell), 0, s.n[k] - 1);
        last[k] = std::clamp(int((b - s.low[k]) / s.cell), 0, s.n[k] - 1);
      }
      for (int y = first[1]; y <= last[1]; ++y)
        for (int x = first[0]; x <= last[0]; ++x) bins[y * s.n[0] + x].push_back(i);
    }
  s.start = {0};
  for (const auto& b : bins) {
    s.entry.insert(s.entry.end(), b.begin(), b.end());
    s.start.push_back(s.entry.size());
  }
}

template class SlidingInterface<2>;
template class SlidingInterface<3>;

}  // namespace seedflow
