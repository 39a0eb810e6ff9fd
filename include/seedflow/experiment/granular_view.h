#pragma once

#include <vector>

#include "seedflow/experiment/view.h"
#include "seedflow/seeds/dem.h"

namespace seedflow {

/// Whole seeds as balls of the real seed's volume.
std::vector<Disc> seeds_from(const View& view, const Dem& dem);
/// All sub-spheres.
std::vector<Disc> spheres_from(const View& view, const Dem& dem);
/// Colour of each seed.
std::vector<int> groups_of(const Dem& dem);
/// Translation and rotation, per seed [J].
double kinetic_energy_per_seed(const Dem& dem);

}  // namespace seedflow
