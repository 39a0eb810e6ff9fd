#include "seedflow/effects/definitions.h"

namespace seedflow {

EffectDefinition added_mass() {
  EffectRecord r;
  r.name = "Added mass";
  r.slot = "force on a body";
  r.summary = "The body accelerates some of the fluid around it.";
  r.equation = "F = C_A rho V (Du/Dt - dv/dt), Du/Dt of the undisturbed flow at the body";
  r.numbers = {
      {"Coefficient", 0.5, "1", Range::between(0, 2), "C_A; 1/2 for a sphere, exact in inviscid flow."}};
  r.references = {
      "Auton, Hunt & Prud'homme (1988), J. Fluid Mech. 197, 241-257, doi:10.1017/S0022112088003246",
      "Magnaudet & Eames (2000), Annu. Rev. Fluid Mech. 32, 659-708, doi:10.1146/annurev.fluid.32.1.659 "
      "(1/2 at any Reynolds number)"};
  r.validity = "lone sphere, any Reynolds number; matters where the body is not much heavier than the fluid";
  r.in_range = [](const FlowAtBody& flow) { return flow.void_fraction > 0.9; };
  r.signature = "measured start slower than simulated from the first instant, same terminal speed";
  return {r, [](const EffectSettings& settings) {
            const double coefficient = settings.numbers[0];
            return [coefficient](const FlowAtBody& flow, EffectMemory&, BodyForce& force) {
              const double mass = coefficient * flow.density * flow.volume;
              force.added_mass += mass;
              force.force += mass * flow.flow_acceleration;
            };
          }};
}

}  // namespace seedflow
