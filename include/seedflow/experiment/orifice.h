#pragma once

#include <mpi.h>

#include <string>
#include <vector>

#include "seedflow/experiment/experiment.h"
#include "seedflow/fluid/parameters.h"
#include "seedflow/mesh/orifice_mesh.h"

namespace seedflow {

/// Experiment "orifice": air through one hole of a disc, driven by a pressure difference, no seed.
struct OrificeParameters {
  std::string name = "orifice";
  OrificeGeometry geometry;
  double pressure_drop = 3000;  ///< ambient minus behind the plate [Pa]
  double ramp = 2e-4;           ///< time over which it grows to its value [s]
  double end_time = 2e-3;       ///< [s]
  double time_step = 2e-5;      ///< [s]
  double average_from = 1e-3;   ///< means are taken from here to the end [s]
  FluidParameters air;          ///< its boundary conditions are set by the experiment

  void declare(Parameters& parameters);
  void check(const Parameters& parameters) const;
};

/// Discharge coefficient  C_d = Q / (A sqrt(2 dp/rho))  of a sharp-edged long orifice by Lichtarowicz,
/// Duggins & Markland 1965 (J. Mech. Eng. Sci. 7, 210-219), fitted for 2 <= l/d <= 10 and
/// 10 <= Re_h <= 2e4:
///   1/C_d = 1/C_du + 20/Re_h (1 + 2.25 l/d) - 0.005 l/d / (1 + 7.5 (log10(0.00015 Re_h))^2),
///   C_du = 0.827 - 0.0085 l/d,  Re_h = rho d sqrt(2 dp/rho) / mu
double long_orifice_discharge(double length_by_diameter, double hydraulic_reynolds);

/// What one orifice did.
struct OrificeResult {
  double flow = 0;            ///< Q, whole hole, mean [m3/s]
  double flow_deviation = 0;  ///< standard deviation of Q / Q [1]
  double discharge = 0;       ///< C_d [1]
  double reynolds = 0;        ///< Re_h [1]
  double imbalance = 0;       ///< largest |inflow - outflow| / flow of a step [1]
  double largest_mass_error = 0, largest_momentum_error = 0;  ///< relative, see Fluid [1]
  double largest_courant = 0;                                 ///< [1]
  double power = 0;                                           ///< of the pressure, mean [W]
  unsigned int cells = 0;
  double seconds = 0;                         ///< CPU, this rank [s]
  std::vector<double> z, pressure, velocity;  ///< along the axis at the end [m], [Pa], [m/s]
};

/// Computes it; writes series.csv into `folder` unless empty.
OrificeResult run_orifice(const OrificeParameters& parameters, const std::string& folder, MPI_Comm comm);

int run_orifice_experiment(const RunOptions& options);
void describe_orifice(std::ostream& out, const std::string& section);

}  // namespace seedflow
