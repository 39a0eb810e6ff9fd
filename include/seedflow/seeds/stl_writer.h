#pragma once

#include <iosfwd>

#include "seedflow/seeds/stl.h"

namespace seedflow {

/// Writes a surface as binary STL: coordinates in single precision, in units of `unit` [m].
void write_stl(const TriangleSurface& surface, double unit, std::ostream& out);

}  // namespace seedflow
