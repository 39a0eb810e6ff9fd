#pragma once

#include <deal.II/base/tensor.h>

#include <vector>

namespace seedflow {

/// Numbers of this rank that become their sums over all ranks, in one message.
class RankSums {
 public:
  /// x must stay where it is until sum().
  void include(double& x) { number.push_back(&x); }
  template <int dim>
  void include(dealii::Tensor<1, dim>& v) {
    for (int d = 0; d < dim; ++d) include(v[d]);
  }
  template <class T>
  void include(std::vector<T>& list) {
    for (T& x : list) include(x);
  }
  void sum(MPI_Comm communicator) {
    std::vector<double> value;
    for (const double* x : number) value.push_back(*x);
    MPI_Allreduce(MPI_IN_PLACE, value.data(), static_cast<int>(value.size()), MPI_DOUBLE, MPI_SUM,
                  communicator);
    for (std::size_t k = 0; k < value.size(); ++k) *number[k] = value[k];
    number.clear();
  }

 private:
  std::vector<double*> number;
};

}  // namespace seedflow
