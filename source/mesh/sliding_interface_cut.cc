#include <algorithm>
#include <cmath>

#include "seedflow/mesh/sliding_interface.h"
#include "sliding_polygon.h"

namespace seedflow {

namespace {

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

}  // namespace

template <int dim>
void SlidingInterface<dim>::turn_to(double angle) {
  present = angle;
  turn_matrix = description.rotation(angle);
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
  for (int c = 0; c < n_corners; ++c) x[c] = face.vertex[vertex_at(face.number, c)];
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
  const auto inside = face.vertex[vertex_at(face.number ^ 1u, 0)] - x[0];
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
    p.position = description.centre + turn_matrix * (p.position - description.centre);
    p.normal = turn_matrix * p.normal;
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

#define SEEDFLOW_CUT(dim)                                                       \
  template void SlidingInterface<dim>::turn_to(double);                         \
  template typename SlidingInterface<dim>::FacePoint SlidingInterface<dim>::at( \
      const Face&, const dealii::Point<dim - 1>&) const;                        \
  template void SlidingInterface<dim>::gauss_weights(const Face&, std::vector<double>&) const;
SEEDFLOW_CUT(2)
SEEDFLOW_CUT(3)

}  // namespace seedflow
