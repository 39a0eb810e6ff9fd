#pragma once

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

namespace seedflow {

/// A cell with (bi- or tri-)linear edges and what a search must know of it. In the cell's own coordinates
/// s in [-1/2, 1/2]^dim,  x(s) = sum_m coefficient[m] prod_{d in m} s_d,  m a set of directions (bits).
template <int dim>
struct alignas(64) MultilinearCell {
  // What decides most searches comes first: two cache lines.
  dealii::Tensor<2, dim> inverse;  ///< of dx/ds at the centre [1/m]
  double bend = 0;                 ///< how far s may lie from inverse (x - centre) for any x of the cell [1]
  double reach = 1e-9;       ///< a point this far outside, in parts of the width, may still be given to it
  std::int32_t number = -1;  ///< what the search returns
  bool alone = true;  ///< false: cells nearby may overlap it or leave gaps (hanging nodes on a curved face)
  std::array<dealii::Tensor<1, dim>, 1 << dim> coefficient;  ///< the first is the centre [m]

  /// Inside by more than this, no neighbour can claim the point too: 1e5 times round-off.
  static constexpr double certainty = 1e-10;

  /// Vertices in lexicographic order.
  explicit MultilinearCell(const std::array<dealii::Point<dim>, 1 << dim>& vertices);

  /// By how much the point lies outside, largest |s_d| - 1/2, in parts of the cell's width; negative inside.
  /// By Newton's method; for a cell that is `alone` only until the sign is certain. Infinity well beyond
  /// `reach`.
  double outside(const dealii::Point<dim>& x) const;
};

/// Which of many cells holds a point: the cells' bounding boxes in a grid of bins, each bin divided further
/// where cells are small, so that a bin knows a few cells only whatever the grading of the mesh.
template <int dim>
class CellBins {
 public:
  struct Found {
    std::int32_t number = -1;
    double outside = std::numeric_limits<double>::infinity();
    bool certain = false;  ///< no other cell can hold the point
  };

  explicit CellBins(std::vector<MultilinearCell<dim>> cells);

  /// Improves `best`: the cell which the point is deepest in or nearest to, the first one of equals.
  void search(const dealii::Point<dim>& x, Found& best) const;

  /// Calls visit(number) once for each cell whose bounding box overlaps [low, high].
  template <typename Visit>
  void in_box(const dealii::Point<dim>& low, const dealii::Point<dim>& high, const Visit& visit) const;

  std::size_t memory_consumption() const;

 private:
  using Index = std::array<int, dim>;
  struct Box {
    dealii::Point<dim> low, high;
  };
  /// Bin of a coordinate, clamped to the grid.
  Index bin_of(const dealii::Point<dim>& x) const;
  Index part_of(const dealii::Point<dim>& x, const Index& bin, int parts) const;
  std::size_t flat(const Index& i, const Index& size) const {
    std::size_t k = 0;
    for (int d = dim - 1; d >= 0; --d) k = k * size[d] + i[d];
    return k;
  }
  static Index cube(int parts) {
    Index size;
    size.fill(parts);
    return size;
  }
  template <typename Do>
  static void for_each(const Index& first, const Index& last, const Do& call);
  /// Calls call(leaf, bin, part) for every leaf that a box overlaps.
  template <typename Do>
  void leaves_in(const dealii::Point<dim>& low, const dealii::Point<dim>& high, const Do& call) const;

  std::vector<MultilinearCell<dim>> list;
  std::vector<Box> box;
  dealii::Point<dim> origin;
  dealii::Tensor<1, dim> size, inverse_size;  ///< of a bin [m], [1/m]
  Index n{};
  std::vector<std::int32_t> parts;    ///< of each bin per direction
  std::vector<std::uint32_t> leaf;    ///< first leaf of each bin
  std::vector<std::uint32_t> first;   ///< of each leaf in `member`
  std::vector<std::uint32_t> member;  ///< places in `list`
};

template <int dim>
template <typename Do>
void CellBins<dim>::for_each(const Index& first, const Index& last, const Do& call) {
  for (int d = 0; d < dim; ++d)
    if (first[d] > last[d]) return;
  Index i = first;
  while (true) {
    call(i);
    int d = 0;
    while (d < dim && i[d] == last[d]) {
      i[d] = first[d];
      ++d;
    }
    if (d == dim) return;
    ++i[d];
  }
}

template <int dim>
template <typename Do>
void CellBins<dim>::leaves_in(const dealii::Point<dim>& low, const dealii::Point<dim>& high,
                              const Do& call) const {
  for_each(bin_of(low), bin_of(high), [&](const Index& bin) {
    const std::size_t b = flat(bin, n);
    for_each(part_of(low, bin, parts[b]), part_of(high, bin, parts[b]),
             [&](const Index& part) { call(leaf[b] + flat(part, cube(parts[b])), bin, part); });
  });
}

template <int dim>
template <typename Visit>
void CellBins<dim>::in_box(const dealii::Point<dim>& low, const dealii::Point<dim>& high,
                           const Visit& visit) const {
  if (list.empty()) return;
  leaves_in(low, high, [&](std::size_t at, const Index& bin, const Index& part) {
    for (std::uint32_t k = first[at]; k < first[at + 1]; ++k) {
      const Box& b = box[member[k]];
      dealii::Point<dim> corner;  // of the common part of both boxes: lies in one leaf only
      bool overlap = true;
      for (int d = 0; d < dim; ++d) {
        overlap = overlap && b.low[d] <= high[d] && b.high[d] >= low[d];
        corner[d] = std::max(b.low[d], low[d]);
      }
      if (!overlap) continue;
      const Index own = bin_of(corner);
      if (own == bin && part_of(corner, own, parts[flat(own, n)]) == part) visit(list[member[k]].number);
    }
  });
}

}  // namespace seedflow
