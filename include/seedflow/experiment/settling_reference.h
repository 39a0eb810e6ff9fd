#pragma once

#include <string>
#include <vector>

#include "seedflow/experiment/simulation_parameters.h"

namespace seedflow {

/// What a settling seed is compared with. Source of the numbers: Xu et al. 2024, Agriculture 14, 752
/// (doi:10.3390/agriculture14050752), section 3.2.4, Eq. 10 and Table 5.
namespace settling_reference {

/// Table 5: settling speed [m/s] at 0.05, 0.10, 0.15 and 0.20 s of the model with n sub-spheres; empty if the
/// paper has no such model. Simulated in the paper, not measured.
std::vector<double> table_5(int n_sub_spheres);
inline const std::vector<double> table_5_times = {0.05, 0.10, 0.15, 0.20};  ///< [s]

/// Eq. 10, the paper's reference line: Stokes' terminal speed [m/s]. Valid for Re << 1 only.
double stokes_speed(const SimulationParameters& p);

/// Terminal speed [m/s] of the whole seed as one sphere with full buoyancy and the smooth Schiller-Naumann
/// drag: what the seed does in a large vessel.
double sphere_speed(const SimulationParameters& p);

/// Speeds [m/s] of that sphere from rest at the given times, with added mass and history force.
std::vector<double> sphere_start(const SimulationParameters& p, const std::vector<double>& times);

/// Terminal speed [m/s] if every sub-sphere were dragged as if alone by fluid at rest, one-way: the analytic
/// root of the literal Eqs. 6-7 with the given buoyant volume of the seed [m3].
double literal_one_way_speed(const SimulationParameters& p, double sub_sphere_diameter,
                             double buoyant_volume);

}  // namespace settling_reference

}  // namespace seedflow
