#pragma once

#include <string>

#include "seedflow/seeds/material.h"

namespace seedflow {

class Parameters;

/// How much of each physical time a DEM step may use.
struct TimeStepParameters {
  double rayleigh_fraction = 0.4;  ///< of the Rayleigh time of the smallest sub-sphere [1]
  double hertz_fraction = 0.1;     ///< of the shortest Hertz contact [1]
  double bond_fraction = 0.9;      ///< of 2/omega_max of the bonded seed [1]
  double impact_speed = 1.0;       ///< fastest expected impact, for the Hertz contact time [m/s]

  void declare(Parameters& parameters);
};

/// One limit: the step may not be above `step`.
struct TimeStepLimit {
  std::string cause;    ///< e.g. "Rayleigh wave, sub-spheres of radius 0.0004 m of template 'N70'"
  double full = 0;      ///< the physical time or stability limit itself [s]
  double fraction = 1;  ///< allowed part of it [1]
  std::string setting;  ///< the entry that holds the fraction
  double step() const { return fraction * full; }
};

/// Time a Rayleigh wave needs around half a sphere, pi R sqrt(rho/G)/(0.1631 nu + 0.8766) [s] (Li et al.
/// 2005). `density` [kg/m3] is that of the sub-sphere, after the mass correction of Eq. 9.
double rayleigh_time(double radius, double density, const Material& material);

/// Duration of a Hertzian impact, 2.87 (m*^2/(R* E*^2 v))^(1/5) [s] (Johnson 1985).
double hertz_time(double reduced_radius, double reduced_mass, double young, double speed);

}  // namespace seedflow
