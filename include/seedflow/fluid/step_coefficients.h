#pragma once

#include "seedflow/base/lane.h"
#include "seedflow/fluid/time_scheme.h"

namespace seedflow {

/// The coefficients of one step at a point, shared by its kernels so that what the momentum equation leaves
/// out of the pressure gradient is exactly what the correction adds. k: polynomial degree, J: Jacobian of the
/// cell, so that |J^-1 w| is |w|/h and |J^-1|^2/dim is 1/h^2 on a cube of edge h.
struct StepCoefficients {
  double density = 1, viscosity = 1;
  bool model_a = true;
  bool dynamic_subscales = false, full_stress = false;
  double stabilization = 1, upwinding = 1;
  double eddy_viscosity = 0;  ///< strength times C_w^2; 0: none
  int degree = 1;
  TimeScheme time;

  /// M = rho a0 eps/dt + beta [kg/(m3 s)]
  SEEDFLOW_INLINE Lanes inertia(Lanes eps, Lanes beta) const {
    return density * time.now / time.dt * eps + beta;
  }
  /// c: share of the pressure gradient that acts on the air
  SEEDFLOW_INLINE Lanes share(Lanes eps) const { return model_a ? eps : broadcast(1.0); }
  /// theta = M / (M + eps (4 mu k^2/h^2 + 2 rho k |w|/h)): the stabilisation's time kappa theta = c / (that
  /// sum).
  /// mu: viscosity, eddies included [Pa s].
  SEEDFLOW_INLINE Lanes theta(Lanes m, Lanes eps, Lanes mu, Lanes speed_by_h, Lanes inverse_h2) const {
    return stabilization * m /
           (m + eps * (4.0 * mu * degree * degree * inverse_h2 + 2.0 * density * degree * speed_by_h));
  }
  /// SUPG time [s]: ((2/dt)^2 + (2 k |w|/h)^2 + 9 (4 nu k^2/h^2)^2 + (beta/(rho eps))^2)^(-1/2), after
  /// Tezduyar & Osawa 2000, doi:10.1016/S0045-7825(00)00211-5, with the drag as a further rate.
  SEEDFLOW_INLINE Lanes upwind_time(Lanes eps, Lanes beta, Lanes mu, Lanes speed_by_h,
                                    Lanes inverse_h2) const {
    const Lanes convective = 2.0 * degree * speed_by_h;
    const Lanes viscous = 12.0 / density * mu * degree * degree * inverse_h2;
    const Lanes drag = beta / (density * eps);
    const double rate = 2.0 / time.dt;
    return upwinding / lane_sqrt(rate * rate + convective * convective + viscous * viscous + drag * drag);
  }
};

}  // namespace seedflow
