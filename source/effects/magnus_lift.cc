#include <cmath>

#include "seedflow/effects/definitions.h"
#include "seedflow/effects/drag_laws.h"

namespace seedflow {

EffectDefinition magnus_lift() {
  EffectRecord r;
  r.name = "Magnus lift";
  r.slot = "force on a body";
  r.summary = "Lift of a body spinning relative to the fluid.";
  r.equation =
      "F = pi/8 rho d^2 C_L |u - v|/|W| W x (u - v), W = curl u/2 - omega_body. Form Rubinow-Keller: C_L = d "
      "|W|/|u - "
      "v|. Form Oesterle-Bui Dinh: C_L = 0.45 + (Re_W/Re - 0.45) exp(-0.05684 Re_W^0.4 Re^0.3), Re_W = rho "
      "d^2 |W|/mu";
  r.choices = {{"Form",
                "Oesterle-Bui Dinh",
                {"Oesterle-Bui Dinh", "Rubinow-Keller"},
                "Finite-Re correlation, or the result for small Re."}};
  r.references = {"Rubinow & Keller (1961), J. Fluid Mech. 11, 447-459, doi:10.1017/S0022112061000640",
                  "Oesterle & Bui Dinh (1998), Exp. Fluids 25, 16-22, doi:10.1007/s003480050203"};
  r.validity = "Re < 140 (form Rubinow-Keller: Re < 1); fitted for spin ratios d |W|/(2 |u - v|) of 1 to 6";
  r.in_range = [](const FlowAtBody& flow) { return slip_reynolds(flow) < 140; };
  r.signature = "sideways drift in proportion to the spin, opposite for opposite spin";
  return {r, [](const EffectSettings& settings) {
            const bool finite = settings.choices[0] == "Oesterle-Bui Dinh";
            return [finite](const FlowAtBody& flow, EffectMemory&, BodyForce& force) {
              const Vec3 spin = 0.5 * flow.flow_vorticity - flow.angular_velocity;
              const double rate = norm(spin), speed = norm(slip(flow)), d = flow.diameter;
              if (rate == 0 || speed == 0) return;
              double lift = d * rate / speed;  // = Re_W / Re
              if (finite) {
                const double re = slip_reynolds(flow), re_w = lift * re;
                lift = 0.45 + (lift - 0.45) * std::exp(-0.05684 * std::pow(re_w, 0.4) * std::pow(re, 0.3));
              }
              force.force +=
                  (M_PI / 8 * flow.density * d * d * lift * speed / rate) * cross(spin, slip(flow));
            };
          }};
}

}  // namespace seedflow
