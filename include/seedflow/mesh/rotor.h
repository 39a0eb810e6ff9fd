#pragma once

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>
#include <deal.II/base/types.h>

#include <cmath>
#include <string>
#include <vector>

namespace seedflow {

/// The part of a mesh that turns rigidly about an axis, and where it meets the part that stands.
///
/// Rotor and stator are one triangulation without common vertices; the rotor's cells carry `material`. Each
/// pair names the boundary of the rotor and the boundary of the stator that slide over one another: both lie
/// in one plane across the axis, or (always in 2D) on one cylinder around it. Where a face of either side has
/// no partner there is a wall.
template <int dim>
struct Rotor {
  struct Pair {
    std::string rotor, stator;
    /// What closes a face of the rotor that has no partner: false, a wall that stands; true, one that turns
    /// with the rotor. A face of the stator without partner is closed by the rotor, which turns.
    bool uncovered_rotor_turns = false;
  };
  dealii::types::material_id material = 1;
  dealii::Point<dim> centre;             ///< a point of the axis [m]
  dealii::Tensor<1, 3> axis = z_axis();  ///< direction; in 2D always z
  std::vector<Pair> pairs;

  static dealii::Tensor<1, 3> z_axis() {
    dealii::Tensor<1, 3> a;
    a[2] = 1;
    return a;
  }
  /// Unit vector of `axis`.
  dealii::Tensor<1, 3> direction() const { return axis / axis.norm(); }
  /// Rotation by `angle` [rad] about the axis, counter-clockwise seen from its tip (Rodrigues' formula).
  dealii::Tensor<2, dim> rotation(double angle) const {
    const double c = std::cos(angle), s = std::sin(angle);
    const dealii::Tensor<1, 3> a = dim == 3 ? direction() : z_axis();
    dealii::Tensor<2, dim> r;
    for (int i = 0; i < dim; ++i)
      for (int j = 0; j < dim; ++j) {
        r[i][j] = (i == j ? c : 0.0) + (1 - c) * a[i] * a[j];
        const int k = 3 - i - j;  // i, j, k are 0, 1, 2 in some order
        if (i != j) r[i][j] -= s * ((j - i + 3) % 3 == 1 ? a[k] : -a[k]);
      }
    return r;
  }
  dealii::Point<dim> turned(const dealii::Point<dim>& x, double angle) const {
    return centre + rotation(angle) * (x - centre);
  }
  /// Velocity of the rotor at x, omega x (x - centre) [m/s], for the angular velocity `speed` [rad/s].
  dealii::Tensor<1, dim> velocity(const dealii::Point<dim>& x, double speed) const {
    return speed * across(x - centre);
  }
  /// axis x v
  dealii::Tensor<1, dim> across(const dealii::Tensor<1, dim>& v) const {
    dealii::Tensor<1, dim> r;
    const dealii::Tensor<1, 3> a = dim == 3 ? direction() : z_axis();
    if constexpr (dim == 2) {
      r[0] = -v[1];
      r[1] = v[0];
    } else {
      r = dealii::cross_product_3d(a, v);
    }
    return r;
  }
};

}  // namespace seedflow
