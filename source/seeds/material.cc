#include "seedflow/seeds/material.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <vector>

#include "seedflow/base/error.h"
#include "seedflow/base/nearest_name.h"
#include "seedflow/base/parameters.h"

namespace seedflow {
namespace {

const std::vector<std::string> tangential_models{"Mindlin without slip", "Mindlin with partial slip"},
    rolling_models{"none", "constant torque", "EPSD"}, restitution_laws{"constant", "viscoelastic"},
    counterparts{"sphere", "plane"}, cohesions{"none", "JKR", "capillary bridge", "by strength"};

void require_option(const std::string& where, const char* entry, const std::string& value,
                    const std::vector<std::string>& options) {
  if (std::find(options.begin(), options.end(), value) == options.end())
    throw InputError(where + "'" + entry + "' cannot be '" + value + "'. " +
                     suggestion(value, options, "value"));
}

void require(bool fulfilled, const std::string& where, const char* entry, double value, const char* allowed) {
  if (fulfilled) return;
  std::ostringstream text;
  text << where << "'" << entry << "' is " << value << "; " << allowed;
  throw InputError(text.str());
}

}  // namespace

void Material::declare(Parameters& p) {
  p.number("Density", density, "kg/m3", Range::positive(), "Density of the material.");
  p.number("Poisson ratio", poisson_ratio, "1", Range::between(0, 0.5), "Poisson's ratio.");
  p.number("Shear modulus", shear_modulus, "Pa", Range::positive(), "Shear modulus G.");
}

void ContactProperties::declare(Parameters& p) {
  p.number("Restitution", restitution, "1", Range{0, 1, true}, "Coefficient of restitution.");
  p.number("Static friction", static_friction, "1", Range::non_negative(),
           "Coulomb's coefficient of friction.");
  p.number("Rolling friction", rolling_friction, "1", Range::non_negative(),
           "Coefficient of rolling friction.");
  p.choice(
      "Tangential model", tangential_model, tangential_models,
      "Without slip: spring 8 G* a up to Coulomb's limit, the usual one. With partial slip: softer where "
      "the rim of the contact slips (Walton & Braun 1986), which small impact angles show.");
  p.choice("Rolling model", rolling_model, rolling_models,
           "constant torque: mu_r N R against the rotation. EPSD: elastic-plastic spring and dashpot (Ai et "
           "al. 2011), the one that comes to rest.");
  p.number("Rolling damping ratio", rolling_damping, "1", Range::between(0, 1),
           "EPSD: of the rolling oscillation.");
  p.number("Mobilised rolling damping", mobilised_damping, "1", Range::between(0, 1),
           "EPSD: part of the dashpot that stays while the rolling spring slips.");
  p.choice(
      "Restitution law", restitution_law, restitution_laws,
      "viscoelastic: restitution falls with the impact speed (Brilliantov et al. 1996); Restitution then "
      "holds for the impact described by the next three entries.");
  p.number("Restitution speed", restitution_speed, "m/s", Range::positive(), "Of that impact.");
  p.number("Restitution diameter", restitution_diameter, "m", Range::positive(),
           "Of the sphere in that impact.");
  p.choice("Restitution counterpart", restitution_counterpart, counterparts,
           "What it hit: another such sphere, or a plane.");
  p.choice("Cohesion", cohesion, cohesions,
           "JKR: adhesion of dry surfaces (Johnson et al. 1971). Capillary bridge: liquid (Willett et al. "
           "2000).");
  p.number("Surface energy", surface_energy, "J/m2", Range::non_negative(),
           "JKR: work of adhesion w of the two surfaces; pull-off force 3/2 pi w R*.");
  p.number("Surface tension", surface_tension, "N/m", Range::non_negative(), "Of the bridge's liquid.");
  p.number("Contact angle", contact_angle, "rad", Range::between(0, 1.5), "Of the liquid on both bodies.");
  p.number("Bridge volume", bridge_volume, "m3", Range::non_negative(), "Liquid in one bridge.");
}

void ContactProperties::check(const std::string& where) const {
  require(restitution > 0 && restitution <= 1, where, "Restitution", restitution,
          "allowed is above 0 up to 1.");
  require(static_friction >= 0, where, "Static friction", static_friction, "allowed is 0 or more.");
  require(rolling_friction >= 0, where, "Rolling friction", rolling_friction, "allowed is 0 or more.");
  require_option(where, "Tangential model", tangential_model, tangential_models);
  require_option(where, "Rolling model", rolling_model, rolling_models);
  require_option(where, "Restitution law", restitution_law, restitution_laws);
  require_option(where, "Restitution counterpart", restitution_counterpart, counterparts);
  require_option(where, "Cohesion", cohesion, cohesions);
  require(rolling_model != "EPSD" || rolling_friction > 0, where, "Rolling friction", rolling_friction,
          "the rolling model EPSD needs a positive one. Choose 'Rolling model = none' to roll freely.");
  if (cohesion != "none" && tangential_model != "Mindlin without slip")
    throw InputError(where + "'Tangential model = " + tangential_model +
                     "' is made for contacts without cohesion. Choose 'Mindlin without slip'.");
  const bool either = cohesion == "by strength";
  if (cohesion == "JKR" || either) {
    require(surface_energy > 0, where, "Surface energy", surface_energy,
            "cohesion JKR needs a positive one. Choose 'Cohesion = none' for none.");
  } else {
    require(surface_energy == 0, where, "Surface energy", surface_energy,
            "it acts only with 'Cohesion = JKR'. Choose that, or remove the entry.");
  }
  if (cohesion == "capillary bridge" || either) {
    require(surface_tension > 0, where, "Surface tension", surface_tension,
            "a capillary bridge needs a positive one (water: 0.072 N/m).");
    require(bridge_volume > 0, where, "Bridge volume", bridge_volume,
            "a capillary bridge needs a positive one.");
  } else {
    require(bridge_volume == 0, where, "Bridge volume", bridge_volume,
            "it acts only with 'Cohesion = capillary bridge'. Choose that, or remove the entry.");
    require(surface_tension == 0, where, "Surface tension", surface_tension,
            "it acts only with 'Cohesion = capillary bridge'. Choose that, or remove the entry.");
  }
}

}  // namespace seedflow
