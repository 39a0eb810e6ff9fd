#pragma once

#include "seedflow/seeds/dem.h"

namespace seedflow {

/// What the contacts of this instant are like.
struct ContactCensus {
  int n_contacts = 0;              ///< of sub-spheres, with others and with walls
  double largest_overlap = 0;      ///< over the radius of the (smaller) sub-sphere [1]
  double mean_overlap = 0;         ///< the same, averaged over all contacts [1]
  double neighbours_per_seed = 0;  ///< other seeds and walls that a seed touches [1]
  double contacts_per_pair = 0;    ///< of sub-spheres, between two touching seeds; 0 if none touch [1]
};

/// Overlaps are those of the sub-spheres' places now: contacts of the last substep that have come apart since
/// count with overlap 0. Costs about as much as a neighbour search.
ContactCensus contact_census(const Dem& dem);

}  // namespace seedflow
