#pragma once

#include <cstdint>
#include <vector>

#include "seedflow/base/lane.h"

namespace seedflow {

/// Values at the quadrature points in the order of the kernels, [group n_q + point][component], one per lane.
/// A field that is the same everywhere is stored once.
class PointField {
 public:
  explicit PointField(double value = 0) : data(1, broadcast(value)) {}

  bool is_uniform() const { return stride == 0; }
  void set_uniform(double value) {
    data.assign(1, broadcast(value));
    stride = 0;
  }
  /// Room for n values, all 1 (a safe value for unused lanes) unless said otherwise.
  void resize(std::size_t n, double value = 1) {
    data.assign(n, broadcast(value));
    stride = 1;
  }
  SEEDFLOW_INLINE const Lanes& operator[](std::size_t k) const { return data[k * stride]; }
  SEEDFLOW_INLINE Lanes& at(std::size_t k) { return data[k]; }  ///< only if not uniform
  std::vector<Lanes>& raw() { return data; }
  const std::vector<Lanes>& raw() const { return data; }
  void assign_raw(std::vector<Lanes> values, bool uniform) {
    data = std::move(values);
    stride = !uniform;
  }
  double bytes() const { return data.size() * sizeof(Lanes); }

 private:
  std::vector<Lanes> data;
  std::size_t stride = 0;
};

}  // namespace seedflow
