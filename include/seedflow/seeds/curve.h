#pragma once

#include <vector>

#include "seedflow/base/vector.h"

namespace seedflow {

/// Place of each point on a Hilbert curve through the box around all of them, 2^16 cells a side: points near
/// on the curve are near in space (Skilling 2004, doi 10.1063/1.1751381).
std::vector<unsigned long long> curve_keys(const std::vector<Vec3>& points);

}  // namespace seedflow
