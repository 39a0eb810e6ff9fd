#pragma once

#include <string>
#include <vector>

#include "seedflow/base/parameters.h"
#include "seedflow/experiment/observation.h"

namespace seedflow {

/// What is usually uncertain in an experiment with many seeds and no air: the seeds' diameter and density,
/// and the static friction of every pair that seeds make with themselves and with the walls.
/// `wall_materials`: entries that name a material, "Tester/Material".
std::vector<UsualUncertainty> granular_uncertainties(const Parameters& parameters,
                                                     const std::vector<std::string>& wall_materials);

}  // namespace seedflow
