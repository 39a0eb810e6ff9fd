#pragma once

namespace seedflow {

// The dimensionless laws of the truth generator; sources in truth_seed.h.

/// C_D Re/24 of a sphere.
double truth_drag(double reynolds);
/// Drag of a body of that sphericity over that of the equal-volume sphere, both by the correlation of
/// Haider and Levenspiel. Re > 0.
double truth_shape_factor(double reynolds, double sphericity);
/// Drag in a crowd of that void fraction over drag alone; reynolds of the interstitial slip.
double truth_crowd_factor(double reynolds, double void_fraction);
/// Drag on the axis of a tube over drag in the open, x = d/D.
double truth_tube_factor(double x);
/// Drag towards a plane wall over drag in the open; gap between the surfaces in radii.
double truth_approach_factor(double gap);
/// Drag along a plane wall over drag in the open; x = radius over distance of the centre.
double truth_along_factor(double x);
/// J/2.255; e = sqrt(nu |curl u|)/|w|.
double truth_shear_lift(double e);
/// C_L |w|/(|W| d): 1 for small Re; ratio = |W| d/|w|.
double truth_spin_lift(double reynolds, double ratio);
/// F/(rho a^2 w^2) away from a wall; x = a/h.
double truth_wall_lift(double x);

}  // namespace seedflow
