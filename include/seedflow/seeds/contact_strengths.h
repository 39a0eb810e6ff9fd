#pragma once

#include <string>
#include <vector>

namespace seedflow {

class Parameters;

/// Strengths in [0, 2] (the last two: [0, 1]) of the optional physics of contacts, in the entries
/// "Effects/NAME/Strength" like those of the effects of the flow, so that a diagnosis can switch and scale
/// them in the same way: 0 adds exactly nothing, 1 is what the contact pairs say. effects/contact_effects.h
/// describes them.
struct ContactStrengths {
  double rolling_friction = 1;  ///< factor on mu_r
  double adhesion = 1;          ///< factor on JKR's work of adhesion
  double liquid_bridges = 1;    ///< factor on the surface tension
  double speed_dependence = 1;  ///< between constant (0) and viscoelastic (1) damping
  double partial_slip = 1;      ///< between no slip (0) and partial slip (1)

  void declare(Parameters& parameters);
};

}  // namespace seedflow
