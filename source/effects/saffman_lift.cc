#include <cmath>

#include "seedflow/effects/definitions.h"
#include "seedflow/effects/drag_laws.h"

namespace seedflow {
namespace {

/// (1 - 0.3314 sqrt(B)) exp(-Re/10) + 0.3314 sqrt(B) for Re <= 40, 0.0524 sqrt(B Re) above.
double mei(double re, double b) {
  const double root = 0.3314 * std::sqrt(b);
  return re <= 40 ? (1 - root) * std::exp(-re / 10) + root : 0.0524 * std::sqrt(b * re);
}

/// J/2.255 of McLaughlin by Mei's fit; e = sqrt(Re_omega)/Re.
double mclaughlin(double e) {
  return 0.3 * (1 + std::tanh(2.5 * std::log10(e) + 0.191)) * (0.667 + std::tanh(6 * (e - 0.32)));
}

}  // namespace

EffectDefinition saffman_lift() {
  EffectRecord r;
  r.name = "Saffman lift";
  r.slot = "force on a body";
  r.summary = "Lift of a body slipping through sheared fluid.";
  r.equation =
      "F = C 1.615 d^2 sqrt(rho mu/|omega|) (u - v) x omega, omega = curl u. Form Saffman: C = 1. Form Mei, "
      "with "
      "B = d |omega|/(2 |u - v|): C = (1 - 0.3314 sqrt(B)) exp(-Re/10) + 0.3314 sqrt(B) for Re <= 40, "
      "0.0524 sqrt(B Re) above. Form McLaughlin, with e = sqrt(nu |omega|)/|u - v|: C = 0.3 (1 + tanh(2.5 "
      "log10 e + "
      "0.191)) (0.667 + tanh(6 (e - 0.32)))";
  r.choices = {{"Form",
                "Mei",
                {"Mei", "McLaughlin", "Saffman"},
                "Finite-Re correction of Mei; weak shear at small Re, e of any size; or the small-Re result "
                "itself, e >> 1."}};
  r.references = {
      "Saffman (1965), J. Fluid Mech. 22, 385-400, doi:10.1017/S0022112065000824; corrigendum 31 (1968) 624",
      "McLaughlin (1991), J. Fluid Mech. 224, 261-274, doi:10.1017/S0022112091001751",
      "Mei (1992), Int. J. Multiphase Flow 18, 145-147, doi:10.1016/0301-9322(92)90012-6"};
  r.validity =
      "Re < 100, 0.005 < B < 0.4 (McLaughlin: Re < 1, 0.1 < e < 20; Saffman: Re << sqrt(Re_omega) << 1), far "
      "from walls";
  r.in_range = [](const FlowAtBody& flow) {
    const double b = 0.5 * flow.diameter * norm(flow.flow_vorticity) / std::max(norm(slip(flow)), 1e-300);
    return slip_reynolds(flow) < 100 && b < 0.4;
  };
  r.signature = "sideways drift in shear; a body that lags the flow moves towards the faster fluid";
  return {r, [](const EffectSettings& settings) {
            const std::string form = settings.choices[0];
            return [form](const FlowAtBody& flow, EffectMemory&, BodyForce& force) {
              const double vorticity = norm(flow.flow_vorticity), speed = norm(slip(flow));
              if (vorticity == 0 || speed == 0) return;
              double correction = 1;
              if (form == "Mei")
                correction = mei(slip_reynolds(flow), 0.5 * flow.diameter * vorticity / speed);
              else if (form == "McLaughlin")
                correction = mclaughlin(std::sqrt(flow.viscosity / flow.density * vorticity) / speed);
              const double factor = 1.615 * flow.diameter * flow.diameter *
                                    std::sqrt(flow.density * flow.viscosity / vorticity) * correction;
              force.force += factor * cross(slip(flow), flow.flow_vorticity);
            };
          }};
}

}  // namespace seedflow
