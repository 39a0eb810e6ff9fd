#include "seedflow/effects/definitions.h"
#include "seedflow/effects/drag_laws.h"

namespace seedflow {

EffectDefinition faxen_force() {
  EffectRecord r;
  r.name = "Faxen force";
  r.slot = "force on a body";
  r.summary =
      "A body feels the mean of a curved velocity profile over its surface, not the value at its centre.";
  r.equation =
      "F = k d^2/24 laplace u, k the drag coefficient of the effects before it: the drag sees the surface "
      "mean "
      "u + d^2/24 laplace u. Where the coupling averages the velocity over the body already, laplace u is "
      "zero "
      "here";
  r.references = {"Faxen (1922), Ann. Phys. 373, 89-119, doi:10.1002/andp.19223731003",
                  "Maxey & Riley (1983), Phys. Fluids 26, 883-889, doi:10.1063/1.864230"};
  r.validity = "Stokes flow; body small against the length over which the curvature of the profile changes";
  r.in_range = [](const FlowAtBody& flow) { return slip_reynolds(flow) < 1; };
  r.signature =
      "bodies lag a parabolic profile by (2/3) u_max (d/D)^2 in a tube; none in uniform or plainly sheared "
      "flow";
  return {r, [](const EffectSettings&) {
            return [](const FlowAtBody& flow, EffectMemory&, BodyForce& force) {
              force.force +=
                  (force.drag_coefficient * flow.diameter * flow.diameter / 24) * flow.flow_laplacian;
            };
          }};
}

}  // namespace seedflow
