#pragma once

#include "seedflow/base/device_geometry.h"
#include "seedflow/base/parameters.h"

namespace seedflow {

/// The air of the metering device without an air mesh ("hole sinks"), and what drives it. Sections "Air" and
/// "Suction".
struct SuctionParameters {
  double density = 1.2, viscosity = 1.8e-5;  ///< of the air [kg/m3], [Pa s]
  double air_step = 1e-4;                    ///< forces are held over [s]

  double vacuum = -3000;          ///< of the fan at no flow, below ambient [Pa]
  double hole_coefficient = 0.8;  ///< discharge coefficient of a hole [1]
  double gap_coefficient = 0.8;   ///< of the gap between rim and seed [1]
  double seat_roughness = 20e-6;  ///< smallest gap under a seated seed [m]
  bool blocking = true;           ///< seeds in front of a hole narrow it
  double fan_flow = 0;            ///< at which the fan's pressure is used up [m3/s]; 0: at any flow the same

  // Effects, each with a strength (effects/device_effects.h).
  double leak_strength = 0;
  double leak_gap = 50e-6;  ///< between disc and vacuum chamber [m]
  double line_strength = 0;
  double line_loss = 5, line_diameter = 25e-3;  ///< loss coefficient of the suction line [1], diameter [m]
  double vibration_strength = 0;
  double vibration_amplitude = 0.1e-3, vibration_frequency = 50;  ///< of the disc along its axis [m], [1/s]

  void declare(Parameters& parameters);
  /// \param largest_step for the forces of this model of the air [s]
  void check(const Parameters& parameters, double largest_step = 5e-4) const;
};

/// Pressure difference of the vacuum chamber and flow through fan and line, in balance:
///   fan   p = dp_0 (1 - (Q/Q_0)^2)       (Q_0 = 0: dp_0 at any flow)
///   line  loses K rho/2 (Q/A_l)^2
///   holes and leak take Q = S sqrt(2 dp/rho), S the sum of their effective areas.
struct SuctionBalance {
  double drop = 0;  ///< dp of the chamber below ambient [Pa]
  double flow = 0;  ///< Q [m3/s]
};
/// Effective area of the leak around the vacuum chamber [m2].
double leak_area(const SuctionParameters& parameters, const DeviceGeometry& device);
/// \param area S [m2]
SuctionBalance suction_balance(const SuctionParameters& parameters, double area);

}  // namespace seedflow
