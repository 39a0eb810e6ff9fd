#pragma once

#include <string>
#include <vector>

#include "seedflow/base/error.h"
#include "seedflow/effects/slots.h"

namespace seedflow {

/// One published drag law. The drag on a body of volume-equivalent diameter d is
///
///   F = k (u - v),   k = 3 pi mu d f(Re, eps, phi)   [kg/s]
///
/// with the interstitial air velocity u, the body's velocity v and Re = rho d |u - v| / mu (interstitial
/// slip). The factor f is 1 for Stokes drag of a lone sphere; for a lone body C_D = 24 f / Re.
///
/// Convention for the void fraction eps: F is the force of "model A". It excludes the pressure-gradient force
/// -V grad p, which acts beside it (in a suspension grad p holds the weight of the bodies and so carries part
/// of them). "Model B" leaves the dynamic pressure gradient out and uses F / eps instead. Laws for lone
/// bodies ignore eps.
struct DragLaw {
  std::string name;
  std::string equation;
  std::string reference;  ///< with DOI where one exists
  std::string validity;
  double reynolds_max =
      0;  ///< upper end of the fitted range of Re (of the superficial slip where eps matters)
  double void_fraction_min = 1;  ///< lower end of the fitted range of eps
  bool uses_void_fraction = false;
  bool uses_sphericity = false;
  double (*factor)(double reynolds, double void_fraction, double sphericity) = nullptr;
};

/// All laws, the default (smooth Schiller-Naumann) first.
const std::vector<DragLaw>& drag_laws();
std::vector<std::string> drag_law_names();
/// The law of that name. InputError naming the nearest law if there is none.
const DragLaw& drag_law(const std::string& name);

/// rho d |u - v| / mu
double slip_reynolds(const FlowAtBody& flow);
/// C_D = 24 f / Re of the force referred to pi/8 rho d^2 |u - v|^2. Re > 0.
double drag_coefficient(const DragLaw& law, double reynolds, double void_fraction = 1, double sphericity = 1);
/// k [kg/s], see DragLaw.
double momentum_exchange(const DragLaw& law, const FlowAtBody& flow);
/// Speed [m/s] at which the law's drag on a lone sphere equals `force` [N] (>= 0).
double terminal_speed(const DragLaw& law, double force, double diameter, double density, double viscosity,
                      double sphericity = 1);

}  // namespace seedflow
