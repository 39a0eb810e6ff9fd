#include "seedflow/effects/device_effects.h"

#include "seedflow/effects/catalogue.h"
#include "seedflow/effects/contact_effects.h"
#include "seedflow/effects/model_effects.h"

namespace seedflow {
namespace {

EffectRecord device_record(const std::string& name) {
  EffectRecord r;
  r.name = name;
  r.slot = "suction device";
  r.in_range = [](const FlowAtBody&) { return true; };
  return r;
}

EffectRecord seal_leak() {
  EffectRecord r = device_record("Seal leak");
  r.summary = "Air enters between the disc and the rim of the vacuum chamber.";
  r.equation =
      "Q = C s L sqrt(2 dp/rho), s gap, L length of the rim around the chamber's arc, C discharge "
      "coefficient";
  r.references = {
      "Idelchik (2007), Handbook of Hydraulic Resistance, 4th ed., chapter 4 (orifices and slots)"};
  r.validity =
      "gaps so wide that friction in them is small: s^2 u/(12 nu l) above about 1, l width of the rim";
  r.signature = "air flow that stays when all holes are covered; with a weak fan a lower vacuum";
  return r;
}

EffectRecord suction_line_loss() {
  EffectRecord r = device_record("Suction line loss");
  r.summary = "Pressure lost in hose, bends and fittings between fan and vacuum chamber.";
  r.equation = "dp = K rho/2 (Q/A)^2, A cross section of the hose";
  r.references = {"Idelchik (2007), Handbook of Hydraulic Resistance, 4th ed."};
  r.validity = "turbulent flow in the hose (Re above 4000)";
  r.signature = "vacuum that falls with the air flow: lower with open holes than with covered ones";
  return r;
}

EffectRecord disc_vibration() {
  EffectRecord r = device_record("Disc vibration");
  r.summary = "The disc shakes along its axis.";
  r.equation = "z = A sin(2 pi f t)";
  r.references = {"kinematics"};
  r.validity = "amplitudes small against a seed";
  r.signature =
      "carried seeds that fall off at accelerations A (2 pi f)^2 near holding force over mass; a looser pool";
  return r;
}

}  // namespace

std::vector<EffectRecord> device_effect_records() {
  return {seal_leak(), suction_line_loss(), disc_vibration()};
}

std::vector<EffectRecord> all_effect_records() {
  std::vector<EffectRecord> records;
  for (const auto& definition : effect_catalogue()) records.push_back(definition.record);
  for (const auto& others : {contact_effect_records(), device_effect_records(), model_effect_records()})
    records.insert(records.end(), others.begin(), others.end());
  return records;
}

}  // namespace seedflow
