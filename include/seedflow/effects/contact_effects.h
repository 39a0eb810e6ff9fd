#pragma once

#include <vector>

#include "seedflow/effects/effect.h"

namespace seedflow {

/// What is known of the optional physics of contacts, in the form of the catalogue of effects, slot
/// "contact". They act inside the contact law, not on a body in a flow: so they have records but no
/// EffectLaw, their in_range is always true, and their strengths are the entries "Effects/NAME/Strength" of
/// the experiments that have contact pairs. An effect is active if a contact pair chooses its model; its
/// numbers stand there.
std::vector<EffectRecord> contact_effect_records();

}  // namespace seedflow
