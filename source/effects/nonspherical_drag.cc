#include "seedflow/effects/definitions.h"
#include "seedflow/effects/drag_laws.h"

namespace seedflow {

EffectDefinition nonspherical_drag() {
  EffectRecord r;
  r.name = "Nonspherical drag";
  r.slot = "force on a body";
  r.summary = "Shape (sphericity): more drag on a body that is not a sphere, as a factor on it.";
  r.equation =
      "k -> k C_D(Re, phi)/C_D(Re, 1) with the correlation of Haider and Levenspiel, phi = surface of the "
      "sphere of "
      "equal volume / surface of the body";
  r.references = {drag_law("Haider-Levenspiel").reference};
  r.validity = "isometric bodies of random orientation, 0.67 <= phi <= 1, Re < 2.6e5";
  r.in_range = [](const FlowAtBody& flow) {
    return flow.sphericity >= 0.67 && flow.sphericity <= 1 && slip_reynolds(flow) < 2.6e5;
  };
  r.signature = "all terminal speeds too high, the more so the larger Re";
  return {r, [](const EffectSettings&) {
            const DragLaw* law = &drag_law("Haider-Levenspiel");
            return [law](const FlowAtBody& flow, EffectMemory&, BodyForce& force) {
              const double re = slip_reynolds(flow);
              force.drag_coefficient *= law->factor(re, 1, flow.sphericity) / law->factor(re, 1, 1);
            };
          }};
}

}  // namespace seedflow
