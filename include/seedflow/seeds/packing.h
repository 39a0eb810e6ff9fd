#pragma once

#include <cstdint>
#include <vector>

#include "seedflow/base/vector.h"
#include "seedflow/seeds/shape.h"

namespace seedflow {

/// Centres of equal sub-spheres inside a shape.
struct Packing {
  std::vector<Vec3> centre;      ///< [m], in the shape's coordinates
  double smallest_distance = 0;  ///< between two centres [m]; 0 for one sub-sphere
};

/// Packs n spheres of radius r [m] into the shape, each touching it from inside at the most, with the
/// smallest distance between two centres as large as the relaxation finds it. Where that distance is below 2
/// r the spheres overlap by 1 - distance / (2 r), all touching pairs about equally; where it is above they
/// are spread evenly.
///
/// Method: random start, over-dense soft spheres of a packing radius rho relaxed by FIRE (Bitzek et al. 2006,
/// doi 10.1103/PhysRevLett.97.170201), centres kept inside the surface moved inwards by r; rho is then
/// lowered until the overlaps vanish (decompression to the jamming point, O'Hern et al. 2003,
/// doi 10.1103/PhysRevE.68.011306). The best of `attempts` starts is kept. The result depends on nothing but
/// the arguments.
///
/// Errors: InputError if n < 1 or a single sphere of radius r does not fit.
Packing pack_spheres(const Shape& shape, int n, double r, std::uint64_t random_number, int attempts = 4);

}  // namespace seedflow
