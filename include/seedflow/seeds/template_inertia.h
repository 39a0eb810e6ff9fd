#pragma once

#include "seedflow/seeds/seed_template.h"
#include "seedflow/seeds/shape.h"

namespace seedflow {

/// Gives the sub-spheres different densities (SeedTemplate::relative_density) so that the clump's centre of
/// mass and moments of inertia become those of the homogeneous shape it was packed into, then finishes the
/// template.
///
/// With m0_i the masses of Eq. 9 and m_i = m0_i (1 + d_i), the sum of m0_i d_i^2 is minimised under the ten
/// conditions
///   sum m_i = M,  sum m_i x_i = 0,  sum m_i (x_i x_i^T + r_i^2/5 I) = M <x x^T>,
/// which is one symmetric 10 x 10 system (Lagrange multipliers). Both the bonded and the rigid seed then turn
/// like the real one. Errors: InputError if no masses, or none that are all positive, do so (too few
/// sub-spheres, or badly placed).
void match_real_inertia(SeedTemplate& seed, const Shape& shape);

}  // namespace seedflow
