#include <cmath>

#include "seedflow/effects/definitions.h"

namespace seedflow {

EffectDefinition rotational_drag() {
  EffectRecord r;
  r.name = "Rotational drag";
  r.slot = "torque on a body";
  r.summary = "Torque against the spin relative to the fluid.";
  r.equation =
      "T = pi mu d^3 W for Re_W <= 32, T = rho/64 d^5 (12.9/sqrt(Re_W) + 128.4/Re_W) |W| W above; W = curl "
      "u/2 - "
      "omega_body, Re_W = rho d^2 |W|/mu";
  r.references = {"Rubinow & Keller (1961), J. Fluid Mech. 11, 447-459, doi:10.1017/S0022112061000640",
                  "Dennis, Singh & Ingham (1980), J. Fluid Mech. 101, 257-279"};
  r.validity = "lone sphere, Re_W < 1000";
  r.in_range = [](const FlowAtBody& flow) {
    const Vec3 spin = 0.5 * flow.flow_vorticity - flow.angular_velocity;
    return flow.density * flow.diameter * flow.diameter * norm(spin) / flow.viscosity < 1000;
  };
  r.signature = "spin decays towards half the vorticity; without it bodies spin on for ever";
  return {r, [](const EffectSettings&) {
            return [](const FlowAtBody& flow, EffectMemory&, BodyForce& force) {
              const Vec3 spin = 0.5 * flow.flow_vorticity - flow.angular_velocity;
              const double d = flow.diameter, rate = norm(spin);
              const double re = flow.density * d * d * rate / flow.viscosity;
              if (re <= 32)
                force.torque += (M_PI * flow.viscosity * d * d * d) * spin;
              else
                force.torque +=
                    (flow.density / 64 * std::pow(d, 5) * (12.9 / std::sqrt(re) + 128.4 / re) * rate) * spin;
            };
          }};
}

}  // namespace seedflow
