#pragma once

#include <iosfwd>

namespace seedflow {

/// How many neighbours one search listed, on all ranks together.
struct ListSizes {
  /// Within a gap; a pair across ranks counts once.
  struct Within {
    double pairs = 0, spheres = 0, at_walls = 0;
  };
  Within half, whole;  ///< within half the skin and the skin
};

/// Chooses the thickness s of the neighbour lists' skin [m] so that lists and searches together cost least.
///
/// With the way u the two fastest seeds approach each other per substep, a search lasts s/u substeps, so one
/// substep costs
///   (S_0 + S_1 s) u / s + W_0 + W_1 s,  least at s* = sqrt(S_0 u / W_1),
/// S the cost of a search, W that of looking at the listed pairs, both linear in s, from the numbers listed
/// within s/2 and s. u is the way measured since the last search. The skin changes by at most a factor of two
/// from search to search; when seeds have slowed down so much that lists last far longer than expected, a
/// search is made to shrink it.
///
/// Only counts and ways enter, no clock: the choice is reproducible and equal on every number of ranks.
class NeighbourSkin {
 public:
  /// The fixed value, or 0 to choose.
  explicit NeighbourSkin(double fixed_skin = 0) : fixed(fixed_skin) {}

  /// Before a search. `smallest_sphere` and `smallest_seed` are radii [m]: a quarter of the first is the skin
  /// to begin with, half the second its largest value.
  double begin(double smallest_sphere, double smallest_seed);
  /// After a search.
  void found(const ListSizes& sizes, double seeds, double spheres) {
    listed = sizes, n_seeds = seeds, n_spheres = spheres;
  }
  /// Before a search that replaces lists: the seeds came `way` [m] in `substeps`.
  void moved(double way, double substeps);
  /// The lists have lasted for so many substeps that another skin must be better.
  bool is_stale(double substeps) const { return substeps > patience; }

  void save(std::ostream& out) const;
  void load(std::istream& in);

 private:
  double cost_of_search(const ListSizes::Within& within) const;

  double fixed = 0, skin = 0, smallest = 0, largest = 0;
  double patience = 1e300;  ///< [substeps]
  double n_seeds = 0, n_spheres = 0;
  ListSizes listed;
};

}  // namespace seedflow
