#pragma once

#include <string>

#include "seedflow/base/parameters.h"

namespace seedflow {

/// How seeds and air see each other (section "Coupling").
struct CouplingParameters {
  std::string drag_on = "seed";              ///< what is dragged as one body: seed | sub-sphere (the paper)
  std::string exchange_kernel = "gaussian";  ///< gaussian | cell (the paper's Eq. 8)
  std::string void_fraction_kernel = "gaussian";  ///< gaussian | sampled (the paper's Eq. 5) | none
  double kernel_width = 0;               ///< standard deviation of the Gaussian [m]; 0: one seed diameter
  int samples = 10;                      ///< Eq. 5: sample points along a sub-sphere's diameter
  std::string solid_volume = "seed";     ///< volume taken from the air: seed | sub-spheres
  std::string buoyancy_volume = "seed";  ///< volume of the pressure-gradient force: seed | sub-spheres | none
  std::string undisturbed_velocity = "oseen";  ///< none | oseen | transient
  std::string outside = "stop";                ///< bodies outside the air's mesh: stop (the run) | still air
  bool two_way = true;                         ///< false: the air does not feel the seeds
  double lowest_void_fraction = 0.05;          ///< the run stops below [1]

  void declare(Parameters& parameters);
  /// Cross-checks after reading. Throws InputError.
  void check(const Parameters& parameters) const;
};

}  // namespace seedflow
