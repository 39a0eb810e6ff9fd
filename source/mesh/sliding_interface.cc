#include "seedflow/mesh/sliding_interface.h"

#include <deal.II/base/geometry_info.h>
#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "seedflow/base/error.h"

namespace seedflow {

namespace {

constexpr double pi = 3.14159265358979323846;

using Corner = std::array<double, 2>;

double cross(const Corner& a, const Corner& b, const Corner& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

double area_of(const std::vector<Corner>& polygon) {
  double sum = 0;
  for (std::size_t i = 2; i < polygon.size(); ++i) sum += cross(polygon[0], polygon[i - 1], polygon[i]);
  return sum / 2;
}

/// The part of a convex polygon to the left of the line from a to b.
void keep_left(std::vector<Corner>& polygon, const Corner& a, const Corner& b, std::vector<Corner>& result) {
  result.clear();
  const std::size_t n = polygon.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Corner &p = polygon[i], &q = polygon[(i + 1) % n];
    const double dp = cross(a, b, p), dq = cross(a, b, q);
    if (dp >= 0) result.push_back(p);
    if ((dp > 0 && dq < 0) || (dp < 0 && dq > 0)) {
      const double s = dp / (dp - dq);
      result.push_back({p[0] + s * (q[0] - p[0]), p[1] + s * (q[1] - p[1])});
    }
  }
  polygon.swap(result);
}

/// Counter-clockwise order of the corners of a quadrilateral numbered lexicographically.
constexpr int around[4] = {0, 1, 3, 2};

}  // namespace

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

namespace {

/// Vertex of the cell at a corner of one of its faces, corners numbered lexicographically in directions().
template <int dim>
int vertex_at(unsigned int number, int corner) {
  const auto d = SlidingInterface<dim>::directions(number);
  int v = (number % 2) << (number / 2);
  for (int a = 0; a < dim - 1; ++a) v |= ((corner >> a) & 1) << d[a];
  return v;
}

}  // namespace

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
        const auto r = f.vertex[vertex_at<dim>(f.number, c)] - description.centre;
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
    for (int k = 0; k < n_corners; ++k) c[k] = parameter(s, all[i].vertex[vertex_at<dim>(all[i].number, k)]);
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

template <int dim>
void SlidingInterface<dim>::turn_to(double angle) {
  present = angle;
  corner = corner_at_rest;
  const double c = std::cos(angle), s = std::sin(angle);
  for (std::size_t i = 0; i < all.size(); ++i) {
    all[i].covered = 0;
    if (all[i].side != rotor) continue;
    const double radius = surfaces[all[i].pair].radius;
    for (Corner& x : corner[i])
      x = radius > 0 ? Corner{x[0] + radius * angle, x[1]} : Corner{c * x[0] - s * x[1], s * x[0] + c * x[1]};
  }
  cut.clear();
  point.clear();
  for (std::size_t p = 0; p < surfaces.size(); ++p) cut_pair(p);
}

template <int dim>
void SlidingInterface<dim>::cut_pair(int pair) {
  const Surface& s = surfaces[pair];
  const double turn = 2 * pi * s.radius;
  std::vector<std::uint32_t> seen(all.size(), 0);
  std::uint32_t stamp = 0;
  std::vector<Corner> polygon, scratch;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i].pair != pair || all[i].side != rotor) continue;
    double low[2] = {1e300, 1e300}, high[2] = {-1e300, -1e300};
    for (const Corner& c : corner[i])
      for (int k = 0; k < 2; ++k) {
        low[k] = std::min(low[k], c[k]);
        high[k] = std::max(high[k], c[k]);
      }
    // On the cylinder the face is looked for once in every turn that may overlap the table.
    const int first_turn = s.radius > 0 ? int(std::ceil((s.low[0] - high[0]) / turn)) : 0;
    const int last_turn = s.radius > 0 ? int(std::floor((s.high[0] - low[0]) / turn)) : 0;
    for (int t = first_turn; t <= last_turn; ++t) {
      const double shift = t * turn;
      int first[2], last[2];
      bool outside = false;
      for (int k = 0; k < 2; ++k) {
        const double a = low[k] + (k == 0 ? shift : 0), b = high[k] + (k == 0 ? shift : 0);
        outside = outside || b < s.low[k] || a > s.high[k];
        first[k] = std::clamp(int((a - s.low[k]) / s.cell), 0, s.n[k] - 1);
        last[k] = std::clamp(int((b - s.low[k]) / s.cell), 0, s.n[k] - 1);
      }
      if (outside) continue;
      ++stamp;
      for (int y = first[1]; y <= last[1]; ++y)
        for (int x = first[0]; x <= last[0]; ++x)
          for (std::uint32_t e = s.start[y * s.n[0] + x]; e < s.start[y * s.n[0] + x + 1]; ++e) {
            const std::uint32_t j = s.entry[e];
            if (seen[j] == stamp) continue;
            seen[j] = stamp;
            polygon.clear();
            if constexpr (dim == 2) {
              const double a = std::max(low[0] + shift, std::min(corner[j][0][0], corner[j][1][0])),
                           b = std::min(high[0] + shift, std::max(corner[j][0][0], corner[j][1][0]));
              polygon = {{a, 0.0}, {b, 0.0}};
            } else {
              for (const int k : around) polygon.push_back({corner[i][k][0] + shift, corner[i][k][1]});
              if (area_of(polygon) < 0) std::reverse(polygon.begin(), polygon.end());
              const auto& c = corner[j];
              const bool reversed = cross(c[0], c[1], c[3]) < 0;
              for (int k = 0; k < 4 && !polygon.empty(); ++k) {
                const Corner &from = c[around[k]], &to = c[around[(k + 1) % 4]];
                keep_left(polygon, reversed ? to : from, reversed ? from : to, scratch);
              }
            }
            add_piece(i, j, polygon, shift);
          }
    }
  }
}

template <int dim>
dealii::Point<dim - 1> SlidingInterface<dim>::reference_of(std::uint32_t face, const Corner& x) const {
  const auto& c = corner[face];
  dealii::Point<dim - 1> r;
  if constexpr (dim == 2) {
    r[0] = (x[0] - c[0][0]) / (c[1][0] - c[0][0]);
  } else {
    // Newton on x = sum of corners times bilinear functions; exact after one step for parallelograms.
    double s = 0.5, t = 0.5;
    for (int iteration = 0; iteration < 20; ++iteration) {
      double f[2], fs[2], ft[2];
      for (int k = 0; k < 2; ++k) {
        const double b = c[1][k] - c[0][k], d = c[2][k] - c[0][k], e = c[3][k] - c[1][k] - d;
        f[k] = c[0][k] + b * s + d * t + e * s * t - x[k];
        fs[k] = b + e * t;
        ft[k] = d + e * s;
      }
      const double det = fs[0] * ft[1] - fs[1] * ft[0];
      const double ds = (f[0] * ft[1] - f[1] * ft[0]) / det, dt = (fs[0] * f[1] - fs[1] * f[0]) / det;
      s -= ds;
      t -= dt;
      if (std::abs(ds) + std::abs(dt) < 1e-13) break;
    }
    r[0] = s;
    r[1] = t;
  }
  return r;
}

template <int dim>
void SlidingInterface<dim>::add_piece(std::uint32_t a, std::uint32_t b, const std::vector<Corner>& polygon,
                                      double shift) {
  const double smallest = 1e-14 * std::min(all[a].area, all[b].area);
  Piece piece{{a, b}, std::uint32_t(point.size()), 0};
  double area = 0;
  const auto add = [&](const Corner& x, double weight) {
    point.push_back({{reference_of(a, {x[0] - shift, x[1]}), reference_of(b, x)}, weight});
  };
  if constexpr (dim == 2) {
    area = polygon[1][0] - polygon[0][0];
    if (!(area > smallest)) return;
    for (std::size_t q = 0; q < gauss.size(); ++q)
      add({polygon[0][0] + gauss[q][0] * area, 0.0}, gauss_weight[q] * area);
  } else {
    if (polygon.size() < 3) return;
    area = area_of(polygon);
    if (!(area > smallest)) return;
    for (std::size_t k = 2; k < polygon.size(); ++k) {
      const Corner &p = polygon[0], &q = polygon[k - 1], &r = polygon[k];
      const double part = cross(p, q, r) / 2;
      if (!(part > 0)) continue;
      for (std::size_t i = 0; i < triangle_point.size(); ++i) {
        const double s = triangle_point[i][0], t = triangle_point[i][1];
        add({p[0] + s * (q[0] - p[0]) + t * (r[0] - p[0]), p[1] + s * (q[1] - p[1]) + t * (r[1] - p[1])},
            triangle_weight[i] * part);
      }
    }
  }
  piece.end = point.size();
  all[a].covered += area;
  all[b].covered += area;
  cut.push_back(piece);
}

template <int dim>
typename SlidingInterface<dim>::FacePoint SlidingInterface<dim>::at(
    const Face& face, const dealii::Point<dim - 1>& reference) const {
  std::array<dealii::Point<dim>, n_corners> x;
  const bool turns = face.side == rotor;
  for (int c = 0; c < n_corners; ++c) x[c] = face.vertex[vertex_at<dim>(face.number, c)];
  FacePoint p;
  std::array<dealii::Tensor<1, dim>, 2> slope;  // dx / d(reference)
  if constexpr (dim == 2) {
    slope[0] = x[1] - x[0];
    p.position = x[0] + reference[0] * slope[0];
    p.normal[0] = slope[0][1];
    p.normal[1] = -slope[0][0];
  } else {
    const double s = reference[0], t = reference[1];
    slope[0] = (1 - t) * (x[1] - x[0]) + t * (x[3] - x[2]);
    slope[1] = (1 - s) * (x[2] - x[0]) + s * (x[3] - x[1]);
    p.position = x[0] + s * ((1 - t) * (x[1] - x[0]) + t * (x[3] - x[2])) + t * (x[2] - x[0]);
    p.normal = dealii::cross_product_3d(slope[0], slope[1]);
  }
  // Outward: away from the vertex of the cell opposite to corner 0.
  const auto inside = face.vertex[vertex_at<dim>(face.number ^ 1u, 0)] - x[0];
  if (p.normal * inside > 0) p.normal *= -1;
  const Surface& s = surfaces[face.pair];
  if (s.radius > 0) {
    // Rectangles: the reference direction along the arc has a constant rate.
    const auto& c = corner_at_rest[&face - all.data()];
    for (int a = 0; a < dim - 1; ++a) {
      const double arc = c[1 << a][0] - c[0][0];
      if (dim == 2 || std::abs(arc) > std::abs(c[1 << a][1] - c[0][1])) p.arc[a] = 1 / arc;
    }
    p.normal /= face.area;  // area per reference area is constant
  } else {
    p.normal /= p.normal.norm();
  }
  if (turns && present != 0) {
    const auto rotation = description.rotation(present);
    p.position = description.centre + rotation * (p.position - description.centre);
    p.normal = rotation * p.normal;
  }
  return p;
}

template <int dim>
void SlidingInterface<dim>::gauss_weights(const Face& face, std::vector<double>& weight) const {
  weight.resize(gauss.size());
  const auto& c = corner_at_rest[&face - all.data()];
  for (std::size_t q = 0; q < gauss.size(); ++q) {
    double rate = face.area;
    if constexpr (dim == 3) {
      const double s = gauss[q][0], t = gauss[q][1];
      double a[2], b[2];
      for (int k = 0; k < 2; ++k) {
        a[k] = (1 - t) * (c[1][k] - c[0][k]) + t * (c[3][k] - c[2][k]);
        b[k] = (1 - s) * (c[2][k] - c[0][k]) + s * (c[3][k] - c[1][k]);
      }
      rate = std::abs(a[0] * b[1] - a[1] * b[0]);
    }
    weight[q] = gauss_weight[q] * rate;
  }
}

template class SlidingInterface<2>;
template class SlidingInterface<3>;

}  // namespace seedflow
