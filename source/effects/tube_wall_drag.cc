#include <algorithm>
#include <cmath>

#include "seedflow/effects/definitions.h"
#include "seedflow/effects/drag_laws.h"

namespace seedflow {
namespace {

/// Drag in the tube over drag in the open, Stokes flow, on the axis.
double faxen(double x) {
  return 1 / (1 - 2.10444 * x + 2.08877 * x * x * x - 0.94813 * std::pow(x, 5));
}

double haberman(double x) {
  const double x3 = x * x * x, x5 = x3 * x * x;
  return (1 - 0.75857 * x5) / (1 - 2.1050 * x + 2.0865 * x3 - 1.7068 * x5 + 0.72603 * x5 * x);
}

/// Di Felice gives the ratio w = speed in the tube / speed in the open at equal force, so the drag at speed V
/// is the open drag at V/w. The exponent wants Re of the open speed.
double di_felice(const DragLaw& law, double x, double re) {
  const double base = (1 - x) / (1 - 0.33 * x);
  double ratio = 1;
  for (int i = 0; i < 50; ++i) {
    const double re_open = re / ratio;
    const double next = std::pow(base, (3.3 + 0.085 * re_open) / (1 + 0.1 * re_open));
    const bool done = std::abs(next - ratio) < 1e-13;
    ratio = next;
    if (done) break;
  }
  return law.factor(re / ratio, 1, 1) / law.factor(re, 1, 1) / ratio;
}

}  // namespace

EffectDefinition tube_wall_drag() {
  EffectRecord r;
  r.name = "Tube wall drag";
  r.slot = "force on a body";
  r.summary = "More drag on a body settling along a tube, as a factor on the drag.";
  r.equation =
      "k -> k g(x), x = d/D. Form Di Felice: speed ratio w = ((1 - x)/(1 - 0.33 x))^a, a = (3.3 + 0.085 "
      "Re_o)/(1 + 0.1 "
      "Re_o), Re_o in the open, g = f(Re/w)/(w f(Re)), f of Schiller-Naumann. Form Faxen: g = 1/(1 - 2.10444 "
      "x + "
      "2.08877 x^3 - 0.94813 x^5). Form Haberman: g = (1 - 0.75857 x^5)/(1 - 2.1050 x + 2.0865 x^3 - 1.7068 "
      "x^5 + "
      "0.72603 x^6)";
  r.choices = {{"Form",
                "Di Felice",
                {"Di Felice", "Faxen", "Haberman"},
                "Di Felice for any Reynolds number; Faxen and Haberman for Stokes flow."}};
  r.references = {"Di Felice (1996), Int. J. Multiphase Flow 22, 527-533",
                  "Faxen (1923), Ark. Mat. Astron. Fys. 17(27), 1-28",
                  "Haberman & Sayre (1958), David Taylor Model Basin Report 1143"};
  r.validity = "on the axis of a long tube, d/D < 0.9 (Faxen 0.3, Haberman 0.8 and Re < 1), fully developed";
  r.in_range = [](const FlowAtBody& flow) { return flow.diameter < 0.9 * flow.tube_diameter; };
  r.signature = "terminal speed too high, by a factor of d/D alone at small Re and fading with Re";
  return {r, [](const EffectSettings& settings) {
            const std::string form = settings.choices[0];
            const DragLaw* law = &drag_law("Schiller-Naumann");
            const auto stokes = form == "Faxen" ? &faxen : &haberman;
            const bool finite = form == "Di Felice";
            return [=](const FlowAtBody& flow, EffectMemory&, BodyForce& force) {
              const double x = flow.diameter / flow.tube_diameter;
              if (x >= 1)
                throw RunError("Effect 'Tube wall drag': a body of diameter " +
                               std::to_string(flow.diameter) + " m in a tube of " +
                               std::to_string(flow.tube_diameter) +
                               " m. Remedy: the tube's diameter, or Strength = 0.");
              force.drag_coefficient *= finite ? di_felice(*law, x, slip_reynolds(flow)) : stokes(x);
            };
          }};
}

}  // namespace seedflow
