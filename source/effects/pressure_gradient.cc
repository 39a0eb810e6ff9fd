#include "seedflow/effects/definitions.h"

namespace seedflow {

EffectDefinition pressure_gradient() {
  EffectRecord r;
  r.name = "Pressure gradient";
  r.slot = "force on a body";
  r.summary = "Buoyancy and the force of the undisturbed pressure field.";
  r.equation =
      "F = -V (grad p_d + rho g), V buoyant volume, p_d dynamic pressure (hydrostatic part excluded), g "
      "gravity. "
      "Counted once: model-A drag laws exclude it";
  r.references = {"Maxey & Riley (1983), Phys. Fluids 26, 883-889, doi:10.1063/1.864230",
                  "Zhou, Kuang, Chu & Yu (2010), J. Fluid Mech. 661, 482-510, doi:10.1017/S002211201000306X "
                  "(models A and B)"};
  r.validity = "bodies small against the length over which the pressure gradient changes";
  r.in_range = [](const FlowAtBody&) { return true; };
  r.signature = "terminal speed too high in liquids; bodies do not follow accelerated liquid";
  r.standard_strength = 1;
  return {r, [](const EffectSettings&) {
            return [](const FlowAtBody& flow, EffectMemory&, BodyForce& force) {
              force.force -= flow.volume * (flow.pressure_gradient + flow.density * flow.gravity);
            };
          }};
}

}  // namespace seedflow
