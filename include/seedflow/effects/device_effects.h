#pragma once

#include <vector>

#include "seedflow/effects/effect.h"

namespace seedflow {

/// What is known of the imperfections of a suction device, in the form of the catalogue of effects, slot
/// "suction device". They act on the vacuum and on the disc, not on a body in a flow: so they have records
/// but no EffectLaw, their in_range is always true, and their entries "Effects/NAME/Strength" belong to the
/// experiments with such a device (coupling/suction_parameters.h).
std::vector<EffectRecord> device_effect_records();

/// The records of all effects: those of effect_catalogue(), of contacts, of suction devices and of choices of
/// the model.
std::vector<EffectRecord> all_effect_records();

}  // namespace seedflow
