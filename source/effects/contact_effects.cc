#include "seedflow/effects/contact_effects.h"

namespace seedflow {
namespace {

EffectRecord contact_record(const std::string& name) {
  EffectRecord r;
  r.name = name;
  r.slot = "contact";
  r.in_range = [](const FlowAtBody&) { return true; };
  r.standard_strength = 1;
  return r;
}

EffectRecord rolling_friction() {
  EffectRecord r = contact_record("Rolling friction");
  r.summary = "Torque of a contact against rolling.";
  r.equation =
      "M = -mu_r N R_r w/|w| (constant torque); M = -k_r theta - C_r theta', |k_r theta| <= mu_r N R_r "
      "(EPSD)";
  r.references = {
      "Ai, Chen, Rotter & Ooi (2011), Powder Technol. 206, 269-282, doi:10.1016/j.powtec.2010.09.030"};
  r.validity = "seeds that roll; mu_r also stands for shape that the model leaves out";
  r.signature = "steeper heaps, rolling seeds that stop, less mixing in a drum";
  return r;
}

EffectRecord adhesion() {
  EffectRecord r = contact_record("Adhesion");
  r.summary = "Attraction of dry surfaces in contact (JKR).";
  r.equation =
      "delta = a^2/R* - sqrt(2 pi w a/E*), F = 4/3 E* a^3/R* - sqrt(8 pi w E* a^3); pull-off 3/2 pi w R*";
  r.references = {
      "Johnson, Kendall & Roberts (1971), Proc. R. Soc. A 324, 301-313, doi:10.1098/rspa.1971.0141"};
  r.validity = "soft, smooth surfaces: Tabor's parameter (R* w^2/(E*^2 z0^3))^(1/3) above 5";
  r.signature = "seeds that stick at low speed, clusters, steeper heaps of small seeds";
  return r;
}

EffectRecord liquid_bridges() {
  EffectRecord r = contact_record("Liquid bridges");
  r.summary = "Attraction by liquid between surfaces that have touched, up to rupture.";
  r.equation =
      "F = 2 pi R gamma cos(theta)/(1 + 1.05 s + 2.5 s^2), s = S sqrt(R/V), R = 2 R*; rupture at S = (1 + "
      "theta/2)(V^(1/3) + 0.1 V^(2/3)/R)";
  r.references = {"Willett, Adams, Johnson & Seville (2000), Langmuir 16, 9396-9405, doi:10.1021/la000657y"};
  r.validity = "V/R^3 below 0.001 to 0.1, slow motion (no viscous force), no gravity in the bridge";
  r.signature = "moist seeds: steep heaps that hold together, weight-independent pull at a gap";
  return r;
}

EffectRecord speed_dependence() {
  EffectRecord r = contact_record("Restitution that falls with the speed");
  r.summary = "Viscoelastic damping of the contact.";
  r.equation =
      "F_n = 4/3 E* sqrt(R*) (delta^(3/2) + 3/2 A delta^(1/2) delta'); e = 1 - 1.153 b + 0.798 b^2 - ..., b "
      "~ v^(1/5)";
  r.references = {
      "Brilliantov, Spahn, Hertzsch & Poeschel (1996), Phys. Rev. E 53, 5382-5392, "
      "doi:10.1103/PhysRevE.53.5382"};
  r.validity = "impacts without plastic deformation";
  r.signature = "restitution near 1 for slow impacts and lower for fast ones";
  return r;
}

EffectRecord partial_slip() {
  EffectRecord r = contact_record("Partial slip");
  r.summary = "The rim of a contact slips before the contact slides.";
  r.equation = "dT = 8 G* a (1 - sigma (T - T*)/(mu N - sigma T*))^(1/3) ds";
  r.references = {"Walton & Braun (1986), J. Rheol. 30, 949-980, doi:10.1122/1.549893",
                  "Mindlin & Deresiewicz (1953), J. Appl. Mech. 20, 327-344"};
  r.validity = "spheres with Coulomb friction, tangential loads below sliding";
  r.signature = "impacts at small angles lose more tangential speed and gain more spin";
  return r;
}

}  // namespace

std::vector<EffectRecord> contact_effect_records() {
  return {rolling_friction(), adhesion(), liquid_bridges(), speed_dependence(), partial_slip()};
}

}  // namespace seedflow
