#pragma once

#include <vector>

#include "seedflow/base/vector.h"

namespace seedflow {

/// What one sample cell holds.
struct MixingCell {
  int seeds = 0;
  int coloured = 0;  ///< of them of the selected colour
};

/// Lacey's index of mixing, M = (S0^2 - S^2)/(S0^2 - Sr^2) (Lacey 1954, doi:10.1002/jctb.5010040504; the
/// source paper's Eq. 11) with
///   S0^2 = p (1 - p),  Sr^2 = p (1 - p)/N,  S^2 = sum_i w_i (p_i - p)^2,  w_i = n_i/sum n,
/// p the share of the selected colour among all seeds, N the mean number of seeds in the cells that hold any.
/// The weights by number of seeds are the paper's; with them the expectation of S^2 of a random mixture is
/// Sr^2 whatever the numbers in the cells are, so that M = 1 on average. Not limited to [0, 1]: a random
/// mixture scatters about 1.
struct LaceyIndex {
  double index = 0;
  double variance = 0;             ///< S^2
  double segregated = 0;           ///< S0^2
  double mixed = 0;                ///< Sr^2
  double mean_seeds_per_cell = 0;  ///< N
  int n_cells = 0;                 ///< that hold seeds
  double random_scatter = 0;       ///< standard deviation of the index of a random mixture in these cells
};

/// Errors: RunError if all seeds have one colour, or no cell holds more than one seed.
LaceyIndex lacey_index(const std::vector<MixingCell>& cells);

/// Sorts seeds into cells of edges `edge` [m] with corners at multiples of it from the origin; an edge of 0
/// means one cell in that direction.
std::vector<MixingCell> mixing_cells(const std::vector<Vec3>& centres, const std::vector<bool>& coloured,
                                     const Vec3& edge);

}  // namespace seedflow
