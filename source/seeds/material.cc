#include "seedflow/seeds/material.h"

#include "seedflow/base/parameters.h"

namespace seedflow {

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
}

}  // namespace seedflow
