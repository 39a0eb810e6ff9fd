#include "seedflow/effects/definitions.h"
#include "seedflow/effects/drag_laws.h"

namespace seedflow {

EffectDefinition drag() {
  EffectRecord r;
  r.name = "Drag";
  r.slot = "force on a body";
  r.summary = "Quasi-steady drag against the slip.";
  r.equation = "F = k (u - v), k = 3 pi mu d f(Re, eps, phi), Re = rho d |u - v|/mu, C_D = 24 f/Re";
  std::string laws = "C_D and its use of the void fraction eps and the sphericity phi.";
  for (const auto& law : drag_laws()) {
    laws += " " + law.name + ": " + law.equation + "; " + law.validity + ".";
    r.references.push_back(law.name + ": " + law.reference);
  }
  r.choices = {{"Law", drag_laws().front().name, drag_law_names(), laws}};
  r.validity = "the range of the chosen law (default: lone sphere, Re < 1000)";
  r.in_range = [](const FlowAtBody& flow) { return slip_reynolds(flow) < 2e5; };
  r.signature = "without it bodies keep their slip; terminal speeds, response times";
  r.standard_strength = 1;
  return {r, [](const EffectSettings& settings) {
            const DragLaw* law = &drag_law(settings.choices[0]);
            return [law](const FlowAtBody& flow, EffectMemory&, BodyForce& force) {
              force.drag_coefficient += momentum_exchange(*law, flow);
            };
          }};
}

}  // namespace seedflow
