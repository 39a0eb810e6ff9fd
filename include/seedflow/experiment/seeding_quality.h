#pragma once

#include <vector>

namespace seedflow {

/// k of n with the 95 % interval of Wilson (1927, doi:10.1080/01621459.1927.10502953), all in [0, 1]; n = 0:
/// value 0, interval [0, 1].
struct Share {
  double value = 0, low = 0, high = 1;
};
Share share_of(int k, int n);

/// How evenly seeds are laid, in shares of n.
struct SeedingIndices {
  int n = 0;
  Share quality, multiple, miss;
  double precision = 0;  ///< standard deviation of the good spacings over the target; 0 if not by spacing
};

/// By holes: one seed is good, two or more are a multiple, none is a miss.
SeedingIndices indices_of_counts(const std::vector<int>& seeds_per_hole);

/// By spacings on the ground as ISO 7256-1 (in the words of Kachman & Smith 1995, Trans. ASAE 38, 379-387):
/// up to 0.5 of the target is a multiple, above 1.5 a miss, between them good.
SeedingIndices indices_of_spacings(const std::vector<double>& spacing, double target);

/// Distances between seeds that reach the ground at these times from a machine that moves at this speed
/// [m/s].
std::vector<double> spacings(std::vector<double> times, double speed);

}  // namespace seedflow
