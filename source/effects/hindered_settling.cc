#include <algorithm>
#include <cmath>

#include "seedflow/effects/definitions.h"
#include "seedflow/effects/drag_laws.h"

namespace seedflow {
namespace {

/// Rowe's smooth form of the Richardson-Zaki exponent, 4.7 in Stokes flow, 2.35 in Newton's range.
double exponent(double reynolds) {
  const double x = 0.175 * std::pow(reynolds, 0.75);
  return 2.35 * (2 + x) / (1 + x);
}

/// Richardson-Zaki says: with pressure gradient of the suspension, drag at the superficial slip U equals eps
/// times the drag of a lone body at the speed U eps^-n. The exponent wants Re of that lone body.
double richardson_zaki(const DragLaw& lone, const FlowAtBody& flow) {
  const double re = slip_reynolds(flow), eps = flow.void_fraction;
  double n = exponent(re), speed_up = 1;
  for (int i = 0; i < 30; ++i) {
    speed_up = std::pow(eps, 1 - n);
    const double next = exponent(re * speed_up);
    if (std::abs(next - n) < 1e-12) break;
    n = next;
  }
  return eps * speed_up * lone.factor(re * speed_up, 1, 1) / lone.factor(re, 1, 1);
}

double di_felice(const DragLaw& law, const FlowAtBody& flow) {
  const double re = slip_reynolds(flow);
  return law.factor(re, flow.void_fraction, 1) / law.factor(re, 1, 1);
}

}  // namespace

EffectDefinition hindered_settling() {
  EffectRecord r;
  r.name = "Hindered settling";
  r.slot = "force on a body";
  r.summary = "More drag in a crowd of bodies, as a factor on the drag of a lone body.";
  r.equation =
      "k -> k g. Form Richardson-Zaki: settling at U = U_t eps^n relative to the mixture, so g = eps^(2-n) "
      "f(Re eps^(1-n))/f(Re), f of Schiller-Naumann, n = 2.35 (2 + x)/(1 + x), x = 0.175 Re_t^0.75. Form Di "
      "Felice: g "
      "= F_DiFelice(Re, eps)/F_DiFelice(Re, 1). Model-A convention: the pressure gradient of the suspension "
      "acts beside "
      "it";
  r.choices = {{"Form",
                "Di Felice",
                {"Di Felice", "Richardson-Zaki"},
                "Voidage function of the drag, or the settling law turned into a drag factor."}};
  r.references = {"Richardson & Zaki (1954), Trans. Inst. Chem. Eng. 32, 35-53",
                  "Rowe (1987), Chem. Eng. Sci. 42, 2795-2796", drag_law("Di Felice").reference};
  r.validity = "suspensions and beds of like bodies, void fraction 0.4 to 1";
  r.in_range = [](const FlowAtBody& flow) { return flow.void_fraction >= 0.4; };
  r.signature =
      "simulated settling or bed expansion off, the more so the denser the suspension; none when dilute";
  return {r, [](const EffectSettings& settings) {
            const bool zaki = settings.choices[0] == "Richardson-Zaki";
            const DragLaw* law = &drag_law(zaki ? "Schiller-Naumann" : "Di Felice");
            return [=](const FlowAtBody& flow, EffectMemory&, BodyForce& force) {
              force.drag_coefficient *= zaki ? richardson_zaki(*law, flow) : di_felice(*law, flow);
            };
          }};
}

}  // namespace seedflow
