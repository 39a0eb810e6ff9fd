#pragma once

#include "seedflow/effects/effect.h"

namespace seedflow {

// One function per effect, each in a file of its name; catalogue.cc lists them in the order of action.
EffectDefinition drag();
EffectDefinition nonspherical_drag();
EffectDefinition hindered_settling();
EffectDefinition tube_wall_drag();
EffectDefinition plane_wall_drag();
EffectDefinition turbulent_dispersion();
EffectDefinition faxen_force();
EffectDefinition pressure_gradient();
EffectDefinition added_mass();
EffectDefinition history_force();
EffectDefinition saffman_lift();
EffectDefinition wall_lift();
EffectDefinition magnus_lift();
EffectDefinition rotational_drag();
EffectDefinition inferred_law();

}  // namespace seedflow
