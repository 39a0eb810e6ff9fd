#include "seedflow/experiment/lacey_index.h"

#include <array>
#include <cmath>
#include <map>

#include "seedflow/base/error.h"

namespace seedflow {

LaceyIndex lacey_index(const std::vector<MixingCell>& cells) {
  LaceyIndex lacey;
  double seeds = 0, coloured = 0;
  for (const MixingCell& cell : cells) {
    if (cell.seeds == 0) continue;  // weight zero
    seeds += cell.seeds;
    coloured += cell.coloured;
    ++lacey.n_cells;
  }
  if (!(coloured > 0 && coloured < seeds))
    throw RunError("The Lacey index needs seeds of two colours in the picture.");
  const double p = coloured / seeds;
  lacey.mean_seeds_per_cell = seeds / lacey.n_cells;
  if (!(lacey.mean_seeds_per_cell > 1))
    throw RunError(
        "The Lacey index needs cells that hold more than one seed on average. Choose larger "
        "cells.");
  lacey.segregated = p * (1 - p);
  lacey.mixed = lacey.segregated / lacey.mean_seeds_per_cell;
  for (const MixingCell& cell : cells) {
    if (cell.seeds == 0) continue;
    const double share = static_cast<double>(cell.coloured) / cell.seeds;
    lacey.variance += cell.seeds / seeds * (share - p) * (share - p);
  }
  lacey.index = (lacey.segregated - lacey.variance) / (lacey.segregated - lacey.mixed);
  // Var(sum_i n_i (p_i - p)^2) for independent binomial cells: each term has variance
  // q^2 (2 + (1 - 6 q)/(n q)) with q = p (1 - p).
  double variance = 0;
  const double q = lacey.segregated;
  for (const MixingCell& cell : cells)
    if (cell.seeds > 0) variance += q * q * (2 + (1 - 6 * q) / (cell.seeds * q));
  lacey.random_scatter = std::sqrt(variance) / seeds / (lacey.segregated - lacey.mixed);
  return lacey;
}

std::vector<MixingCell> mixing_cells(const std::vector<Vec3>& centres, const std::vector<bool>& coloured,
                                     const Vec3& edge) {
  std::map<std::array<long, 3>, MixingCell> cells;
  for (std::size_t i = 0; i < centres.size(); ++i) {
    std::array<long, 3> at{};
    for (int d = 0; d < 3; ++d)
      at[d] = edge[d] > 0 ? static_cast<long>(std::floor(centres[i][d] / edge[d])) : 0;
    MixingCell& cell = cells[at];
    ++cell.seeds;
    cell.coloured += coloured[i];
  }
  std::vector<MixingCell> all;
  for (const auto& [at, cell] : cells) all.push_back(cell);
  return all;
}

}  // namespace seedflow
