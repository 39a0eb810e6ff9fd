#pragma once

#include <string>

#include "seedflow/diagnose/diagnosis.h"
#include "seedflow/effects/effect.h"

namespace seedflow {

/// An effect of the catalogue as a candidate: its strength, or the entry that stands for it.
Candidate candidate_of(const EffectRecord& effect);

/// An effect by its name; "PATH = PUBLISHED" for another entry of the model that is 0 without the effect; or
/// "PATH = OPTION" for a choice. Errors: InputError.
Candidate read_candidate(const std::string& text);

}  // namespace seedflow
