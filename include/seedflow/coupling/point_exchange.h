#pragma once

#include <deal.II/base/mpi.h>
#include <deal.II/base/tensor.h>

#include <cstdint>
#include <vector>

#include "seedflow/base/vector.h"
#include "seedflow/mesh/quadrature_layout.h"

namespace seedflow {

/// The weights that tie points (sub-spheres, seeds) to the air's quadrature points:
///
///     average:  <u>_p = sum_q w_pq u(x_q)                     (what the point sees)
///     deposit:  f(x_q) = sum_p F_p w_pq / JxW_q               (what the air gets; integral f dV = sum_p F_p)
///
/// One is the transpose of the other, and the weights of a point add up to 1 over all ranks. So an exchange
/// with coefficient k, F_p = k (<u>_p - v_p), equals the volume integral of the deposited force density
/// exactly, and a deposited particle volume is the particle's volume exactly.
///
/// Every rank knows every point and holds the weights of its own quadrature points.
class PointExchange {
 public:
  PointExchange(const QuadratureLayout<3>& layout, MPI_Comm communicator)
      : layout(&layout), comm(communicator) {}

  /// Starts a new set of points; rows are then filled in order: add() for the entries of a point, next() to
  /// end it.
  void clear();
  void add(std::uint32_t quadrature_index, double weight) { entries.push_back({quadrature_index, weight}); }
  void next() { row_end.push_back(entries.size()); }

  /// Scales every row to the sum 1 over all ranks. Returns the indices of the points that have no weight
  /// anywhere (they lie outside the mesh): averages there are zero, deposits go nowhere. Collective.
  std::vector<long> normalize();

  std::size_t n_points() const { return row_end.size(); }
  std::size_t n_entries() const { return entries.size(); }

  /// Averages at all points, the same on every rank. Collective.
  std::vector<Vec3> average(const std::vector<dealii::Tensor<1, 3>>& field) const;
  std::vector<Vec3> average(const std::vector<Vec3>& field) const;
  std::vector<double> average(const std::vector<double>& field) const;

  /// Adds the density of the amounts to the field: [amount]/m3.
  void deposit(const std::vector<Vec3>& amount, std::vector<dealii::Tensor<1, 3>>& density) const;
  void deposit(const std::vector<double>& amount, std::vector<double>& density) const;

 private:
  struct Entry {
    std::uint32_t q;
    double weight;
  };
  const QuadratureLayout<3>* layout;
  MPI_Comm comm;
  std::vector<std::size_t> row_end;
  std::vector<Entry> entries;
};

}  // namespace seedflow
