#include "seedflow/seeds/time_step.h"

#include <cmath>

#include "seedflow/base/parameters.h"

namespace seedflow {

void TimeStepParameters::declare(Parameters& p) {
  const auto section =
      p.section("Time step limits", "A time step above one of these limits is refused before the run.");
  p.number("Rayleigh fraction", rayleigh_fraction, "1", Range{0, 1, true},
           "Largest step as a fraction of the Rayleigh time of the smallest sub-sphere.");
  p.number("Hertz fraction", hertz_fraction, "1", Range{0, 0.5, true},
           "Largest step as a fraction of the shortest Hertz contact at the impact speed.");
  p.number("Bond fraction", bond_fraction, "1", Range{0, 1, true},
           "Largest step as a fraction of 2/omega_max of the bonded seed.");
  p.number("Impact speed", impact_speed, "m/s", Range::positive(), "Fastest impact expected.");
}

double rayleigh_time(double radius, double density, const Material& m) {
  return M_PI * radius * std::sqrt(density / m.shear_modulus) / (0.1631 * m.poisson_ratio + 0.8766);
}

double hertz_time(double reduced_radius, double reduced_mass, double young, double speed) {
  return 2.87 * std::pow(reduced_mass * reduced_mass / (reduced_radius * young * young * speed), 0.2);
}

}  // namespace seedflow
