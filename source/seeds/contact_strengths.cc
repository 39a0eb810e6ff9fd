#include "seedflow/seeds/contact_strengths.h"

#include "seedflow/base/error.h"
#include "seedflow/base/parameters.h"
#include "seedflow/seeds/material.h"

namespace seedflow {

void ContactStrengths::declare(Parameters& p) {
  const auto section = p.section("Effects", "");
  const auto strength = [&](const char* name, double& target, const char* doc, double largest = 2) {
    const auto inner = p.section(name, "");
    p.number("Strength", target, "1", Range::between(0, largest), doc);
  };
  strength("Rolling friction", rolling_friction, "Factor on Rolling friction of all contact pairs.");
  strength("Adhesion", adhesion, "Factor on Surface energy of the pairs with JKR cohesion.");
  strength("Liquid bridges", liquid_bridges,
           "Factor on Surface tension of the pairs with capillary bridges.");
  strength("Restitution that falls with the speed", speed_dependence,
           "Of the pairs with viscoelastic restitution: 0 is constant restitution.", 1);
  strength("Partial slip", partial_slip, "Of the pairs with partial slip: 0 is no slip.", 1);
}

ContactProperties ContactProperties::weakened(const ContactStrengths& s) const {
  ContactProperties p = *this;
  p.rolling_friction *= s.rolling_friction;
  if (p.rolling_friction == 0) p.rolling_model = "none";
  p.surface_energy *= s.adhesion;
  p.surface_tension *= s.liquid_bridges;
  if (cohesion == "by strength") {
    if (s.adhesion > 0 && s.liquid_bridges > 0)
      throw InputError(
          "Effects: Adhesion and Liquid bridges cannot act in the same contact. Give one of them the "
          "strength 0.");
    p.cohesion = s.adhesion > 0 ? "JKR" : s.liquid_bridges > 0 ? "capillary bridge" : "none";
    if (p.cohesion != "JKR") p.surface_energy = 0;
    if (p.cohesion != "capillary bridge") p.surface_tension = p.bridge_volume = 0;
  }
  if ((cohesion == "JKR" && p.surface_energy == 0) ||
      (cohesion == "capillary bridge" && p.surface_tension == 0)) {
    p.cohesion = "none";
    p.bridge_volume = 0;
  }
  p.speed_dependence *= s.speed_dependence;
  p.partial_slip *= s.partial_slip;
  return p;
}

}  // namespace seedflow
