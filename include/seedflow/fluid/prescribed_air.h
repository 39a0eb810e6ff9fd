#pragma once

#include <array>
#include <memory>
#include <string>

#include "seedflow/base/parameters.h"

namespace seedflow {

/// What a flow is at one point.
struct FlowAtPoint {
  Vec3 velocity;           ///< u [m/s]
  Vec3 vorticity;          ///< curl u [1/s]
  Vec3 acceleration;       ///< Du/Dt = du/dt + u . grad u [m/s2]
  Vec3 pressure_gradient;  ///< of the dynamic pressure [Pa/m]
};

/// Section "Air/Prescribed": a flow given by expressions of x, y, z (m) and t (s), for one-way runs that cost
/// milliseconds.
struct PrescribedAirParameters {
  std::array<std::string, 3> velocity{"0", "0", "0"};
  double length_scale = 1e-3;  ///< of the finest structure of the expressions [m]
  double time_scale = 1e-2;    ///< of their fastest change [s]

  void declare(Parameters& parameters);
};

/// Air whose velocity is known beforehand. Derivatives are central differences of the expressions over a
/// thousandth of the given scales; the pressure gradient is the one with which the flow satisfies the
/// momentum balance, grad p = -rho Du/Dt + mu laplace u. Errors: InputError if an expression does not parse
/// or is not finite.
class PrescribedAir {
 public:
  PrescribedAir(const PrescribedAirParameters& parameters, double density, double viscosity);
  ~PrescribedAir();
  PrescribedAir(PrescribedAir&&) noexcept;

  Vec3 velocity(const Vec3& x, double time) const;
  FlowAtPoint at(const Vec3& x, double time) const;

 private:
  struct Expressions;
  std::unique_ptr<Expressions> expressions;
  double density, viscosity, length_step, time_step;
};

}  // namespace seedflow
