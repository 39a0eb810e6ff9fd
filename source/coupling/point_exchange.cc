#include "seedflow/coupling/point_exchange.h"

namespace seedflow {

using dealii::Tensor;

namespace {

Tensor<1, 3> as_tensor(const Vec3& a) {
  Tensor<1, 3> t;
  for (int d = 0; d < 3; ++d) t[d] = a[d];
  return t;
}
double as_tensor(double a) {
  return a;
}

void add_scaled(Vec3& sum, double w, const Tensor<1, 3>& value) {
  sum.x += w * value[0], sum.y += w * value[1], sum.z += w * value[2];
}
void add_scaled(Vec3& sum, double w, const Vec3& value) {
  sum += w * value;
}
void add_scaled(double& sum, double w, double value) {
  sum += w * value;
}

/// Sums arrays of doubles, or of structs of doubles, over the ranks in place.
template <typename T>
void sum_over_ranks(std::vector<T>& values, MPI_Comm comm) {
  if (dealii::Utilities::MPI::n_mpi_processes(comm) == 1 || values.empty()) return;
  MPI_Allreduce(MPI_IN_PLACE, values.data(), static_cast<int>(values.size() * sizeof(T) / sizeof(double)),
                MPI_DOUBLE, MPI_SUM, comm);
}

template <typename Average, typename Entries, typename Value>
std::vector<Average> weighted_sums(const std::vector<std::size_t>& row_end, const Entries& entries,
                                   const std::vector<Value>& field, MPI_Comm comm) {
  std::vector<Average> result(row_end.size());
  std::size_t e = 0;
  for (std::size_t p = 0; p < row_end.size(); ++p)
    for (; e < row_end[p]; ++e) add_scaled(result[p], entries[e].weight, field[entries[e].q]);
  sum_over_ranks(result, comm);
  return result;
}

template <typename Amount, typename Entries, typename Value>
void deposit_rows(const std::vector<std::size_t>& row_end, const Entries& entries,
                  const std::vector<double>& JxW, const std::vector<Amount>& amount,
                  std::vector<Value>& density) {
  std::size_t e = 0;
  for (std::size_t p = 0; p < row_end.size(); ++p) {
    const Value value = as_tensor(amount[p]);
    for (; e < row_end[p]; ++e) density[entries[e].q] += (entries[e].weight / JxW[entries[e].q]) * value;
  }
}

}  // namespace

void PointExchange::clear() {
  row_end.clear();
  entries.clear();
}

std::vector<long> PointExchange::normalize() {
  std::vector<double> sum(row_end.size(), 0.0);
  std::size_t e = 0;
  for (std::size_t p = 0; p < row_end.size(); ++p)
    for (; e < row_end[p]; ++e) sum[p] += entries[e].weight;
  sum_over_ranks(sum, comm);
  std::vector<long> outside;
  e = 0;
  for (std::size_t p = 0; p < row_end.size(); ++p) {
    if (!(sum[p] > 0.0)) outside.push_back(static_cast<long>(p));
    for (; e < row_end[p]; ++e) entries[e].weight /= sum[p];
  }
  return outside;
}

std::vector<Vec3> PointExchange::average(const std::vector<Tensor<1, 3>>& field) const {
  return weighted_sums<Vec3>(row_end, entries, field, comm);
}
std::vector<Vec3> PointExchange::average(const std::vector<Vec3>& field) const {
  return weighted_sums<Vec3>(row_end, entries, field, comm);
}
std::vector<double> PointExchange::average(const std::vector<double>& field) const {
  return weighted_sums<double>(row_end, entries, field, comm);
}
void PointExchange::deposit(const std::vector<Vec3>& amount, std::vector<Tensor<1, 3>>& density) const {
  deposit_rows(row_end, entries, layout->JxW, amount, density);
}
void PointExchange::deposit(const std::vector<double>& amount, std::vector<double>& density) const {
  deposit_rows(row_end, entries, layout->JxW, amount, density);
}

}  // namespace seedflow
