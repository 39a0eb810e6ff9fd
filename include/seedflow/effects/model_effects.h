#pragma once

#include <vector>

#include "seedflow/effects/effect.h"

namespace seedflow {

/// Drag of air at rest on a seed of an experiment that computes no air (heap, sieve, drum): Schiller-Naumann
/// on the volume-equivalent sphere. Not one of EffectSet, whose effects act where there is a flow: the
/// granular experiments apply it (coupling/air_drag.h), in air of the effect's own density and viscosity.
EffectDefinition air_drag();

/// What is known of effects that are a choice of the model, in the form of the catalogue of effects, slot
/// "choice of the model": they have a record but no strength, EffectRecord::entry says which entry of a .prm
/// stands for them. The record of air_drag() is here too.
std::vector<EffectRecord> model_effect_records();

}  // namespace seedflow
