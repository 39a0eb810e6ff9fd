#pragma once

#include "seedflow/seeds/seed_template.h"

namespace seedflow {

/// Bonds every pair of sub-spheres whose centres are nearer than contact_radius_i + contact_radius_j, with
/// contact_radius_i = contact_factor * r_i (the paper's code bonds by contact radius), replacing the bonds
/// there are. Bond radius R_b = bond_factor * min(r_i, r_j): the paper prints none; the smaller sub-sphere's
/// radius is the usual choice (Potyondy & Cundall 2004, doi 10.1016/j.ijrmms.2004.09.011, lambda = 1).
/// Errors: InputError on factors that are not positive.
void bond_by_contact_radius(SeedTemplate& seed, double contact_factor, double bond_factor);

/// Throws InputError unless the bonds hold all sub-spheres together; the message gives the number of pieces
/// and the smallest contact radius (and its factor) that would make it one piece.
void require_one_piece(const SeedTemplate& seed);

/// The smallest contact factor with which bond_by_contact_radius() makes one piece; 0 for a single
/// sub-sphere.
double connecting_contact_factor(const SeedTemplate& seed);

}  // namespace seedflow
