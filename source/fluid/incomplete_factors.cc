#include <algorithm>
#include <cmath>
#include <utility>

#include "row_sum.h"
#include "seedflow/fluid/component_preconditioner.h"

namespace seedflow {

namespace {

/// Owned nodes front by front, each front in the order in which the one before reaches it, at the last
/// reversed. Every part of the mesh begins at its first node.
std::vector<std::uint32_t> reverse_cuthill_mckee(const SparsityStructure& s) {
  const std::uint32_t n = s.n_owned();
  std::vector<std::uint32_t> order;
  order.reserve(n);
  std::vector<char> found(n, 0);
  const auto degree = [&](std::uint32_t i) { return s.row_start[i + 1] - s.row_start[i]; };
  for (std::uint32_t first = 0; first < n; ++first) {
    if (found[first]) continue;
    found[first] = 1;
    std::size_t next = order.size();
    order.push_back(first);
    for (; next < order.size(); ++next) {
      const std::size_t begin = order.size();
      for (std::uint32_t k = s.row_start[order[next]]; k < s.row_start[order[next] + 1]; ++k) {
        const std::uint32_t j = s.column[k];
        if (j >= n || found[j]) continue;
        found[j] = 1;
        order.push_back(j);
      }
      std::stable_sort(order.begin() + begin, order.end(),
                       [&](std::uint32_t a, std::uint32_t b) { return degree(a) < degree(b); });
    }
  }
  std::reverse(order.begin(), order.end());
  return order;
}

/// A = (1 + L) D (1 + U) on the pattern of A, rows and columns in `order`.
class IncompleteFactors : public ComponentPreconditioner {
 public:
  void build(const SparseMatrix& matrix) override {
    if (order.empty()) {
      order = reverse_cuthill_mckee(matrix.structure());
      place.resize(order.size());
      for (std::uint32_t k = 0; k < order.size(); ++k) place[order[k]] = k;
    }
    take(matrix);
    factorise();
  }

  void apply(NodeBlock* z, const NodeBlock* r) override {
    const std::uint32_t n = order.size();
    work.resize(n);
    const auto term = [this](std::uint32_t k) { return double(factor[k]) * work[column[k]]; };
    for (std::uint32_t i = 0; i < n; ++i)
      work[i] = r[order[i]] - row_sum<NodeBlock>(start[i], diagonal[i], term);
    for (std::uint32_t i = n; i-- > 0;)
      z[order[i]] = work[i] = inverse[i] * work[i] - row_sum<NodeBlock>(diagonal[i] + 1, start[i + 1], term);
  }

 private:
  /// The rows of A between owned nodes; zeros, which constrained nodes leave, are no part of the pattern.
  void take(const SparseMatrix& matrix) {
    const std::uint32_t n = order.size();
    const SparseMatrix::Rows rows = matrix.merged();
    start.assign(1, 0);
    column.clear();
    value.clear();
    diagonal.resize(n);
    std::vector<std::pair<std::uint32_t, double>> entries;
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t row = order[i];
      entries.clear();
      for (std::uint32_t k = rows.start[row]; k < rows.start[row + 1]; ++k)
        if (const std::uint32_t j = rows.column[k]; j == row || (j < n && rows.value[k] != 0))
          entries.emplace_back(place[j], rows.value[k]);
      std::sort(entries.begin(), entries.end());
      for (const auto& [j, a] : entries) {
        if (j == i) diagonal[i] = column.size();
        column.push_back(j);
        value.push_back(a);
      }
      start.push_back(column.size());
    }
  }

  /// Row by row; U is kept times D until its row is done.
  void factorise() {
    const std::uint32_t n = order.size();
    inverse.resize(n);
    position.assign(n, -1);
    for (std::uint32_t i = 0; i < n; ++i) {
      const double given = value[diagonal[i]];
      for (std::uint32_t k = start[i]; k < start[i + 1]; ++k) position[column[k]] = k;
      for (std::uint32_t k = start[i]; k < diagonal[i]; ++k) {
        const std::uint32_t j = column[k];
        const double l = value[k] *= inverse[j];
        for (std::uint32_t m = diagonal[j] + 1; m < start[j + 1]; ++m)
          if (const std::int32_t p = position[column[m]]; p >= 0) value[p] -= l * value[m];
      }
      for (std::uint32_t k = start[i]; k < start[i + 1]; ++k) position[column[k]] = -1;
      // Without fill a pivot can vanish even if A is regular; nodes without equation have none.
      double pivot = value[diagonal[i]];
      if (!(std::abs(pivot) > 1e-12 * std::abs(given))) pivot = given != 0 ? given : 1;
      inverse[i] = 1 / pivot;
    }
    factor.resize(value.size());
    for (std::uint32_t i = 0; i < n; ++i) {
      for (std::uint32_t k = start[i]; k < diagonal[i]; ++k) factor[k] = value[k];
      for (std::uint32_t k = diagonal[i] + 1; k < start[i + 1]; ++k) factor[k] = inverse[i] * value[k];
    }
  }

  std::vector<std::uint32_t> order, place;             ///< node of a row; row of a node
  std::vector<std::uint32_t> start, diagonal, column;  ///< of the rows
  std::vector<double> value;                           ///< A, then its factors
  std::vector<float> factor;                           ///< L and U
  std::vector<double> inverse;                         ///< 1/D
  std::vector<std::int32_t> position;                  ///< of a column in the present row, -1: none
  std::vector<NodeBlock> work;
};

}  // namespace

std::unique_ptr<ComponentPreconditioner> make_incomplete_factors() {
  return std::make_unique<IncompleteFactors>();
}

}  // namespace seedflow
