#pragma once

#include <functional>
#include <vector>

#include "seedflow/base/vector.h"
#include "seedflow/effects/thinned_history.h"

namespace seedflow {

// The velocity that a body gives to the fluid around it and then sees itself, when its force is spread over
// the fluid by a Gaussian and the fluid velocity is averaged by a Gaussian. A drag law wants the velocity
// without that part.
//
// Fluid linearised about the uniform stream W = u - v past the body (Oseen), unbounded, void fraction near 1:
//   rho (du/dt + W . grad u) = -grad p + mu lap u + F G(x),   div u = 0,   G(x) = (2 pi a^2)^(-3/2)
//   exp(-x^2/(2 a^2)).
// In Fourier space u(k) = (I - kk/k^2) F exp(-k^2 a^2/2)/(mu k^2 + i rho k.W); the average with a Gaussian of
// width b multiplies by exp(-k^2 b^2/2). Only s^2 = a^2 + b^2 matters. The integral over |k| gives error
// functions and the one over the angle has a closed form, see steady_self_mobility().
//
// Published relatives: Maxey & Patel (2001), Int. J. Multiphase Flow 27, 1603-1626 (Stokes flow, Gaussian
// force); Horwitz & Mani (2016), J. Comput. Phys. 318, 85-109, doi:10.1016/j.jcp.2016.05.034; Evrard, Denner
// & van Wachem (2020), J. Comput. Phys. X 8, 100078 (regularised Stokeslets,
// finite Re).

/// s [m] for a force spread with width a and a velocity averaged with width b (standard deviations, m).
double effective_width(double spread, double average);

/// u = F M/(mu s): along the stream and across it, both dimensionless.
struct SelfMobility {
  double along = 0, across = 0;
};

/// Steady state; reynolds = s |W| / nu. With X = reynolds/sqrt(2), E = exp(X^2) erfc(X):
///   along  = sqrt(pi/2)/(2 pi^2) S,  across = sqrt(pi/2)/(2 pi^2) (H - S/2),
///   S = sqrt(pi)/(2 X) - 1/X^2 + sqrt(pi) (1 - E)/(2 X^3),  H = sqrt(pi) (1 - E)/(2 X).
/// Stokes limit sqrt(2/pi)/(6 pi) both ways; at large reynolds along -> 1/(4 pi reynolds), half the peak of
/// the wake.
SelfMobility steady_self_mobility(double reynolds);

/// The force switched on a time t ago; diffusion_time = nu t / s^2.
SelfMobility startup_self_mobility(double reynolds, double diffusion_time);

struct CarrierFluid {
  double density = 1, viscosity = 1;  ///< [kg/m3], dynamic [Pa s]
};

/// Mean velocity at the body from a steady force on the fluid [N] in the stream `slip` = u - v [m/s].
Vec3 steady_self_velocity(const Vec3& force_on_fluid, const Vec3& slip, double width,
                          const CarrierFluid& fluid);

/// Mean velocity at the body from the impulse [N s] it gave to the fluid `age` [s] ago, when it was
/// `displacement` [m] away from where it is now (seen from the fluid): the transverse part of a Gaussian of
/// variance s^2 + 2 nu age.
Vec3 impulse_self_velocity(const Vec3& impulse_on_fluid, const Vec3& displacement, double age, double width,
                           const CarrierFluid& fluid);

/// Self-induced velocity of a body whose force and motion change, from a thinned record of both: work and
/// memory grow like the logarithm of the number of steps. Keeps its numbers in `memory`, which belongs to the
/// caller (it can be saved and sent).
class TransientSelfVelocity {
 public:
  explicit TransientSelfVelocity(std::vector<double>& memory, double resolution = 16)
      : record(memory, 0, 6), resolution(resolution) {}

  /// `force_on_fluid` [N] acts from the last call (or from for ever ago not at all) up to `time` and is
  /// averaged over that step; `path` [m] is the position of the body in a frame that moves with the
  /// undisturbed fluid.
  void append(double time, const Vec3& force_on_fluid, const Vec3& path);
  /// At the time of the last call [m/s].
  Vec3 velocity(double width, const CarrierFluid& fluid) const;

 private:
  ThinnedHistory record;
  double resolution;
};

/// Mean void-fraction deficit a body of `volume` [m3] spread by one Gaussian sees through the other: V (2 pi
/// s^2)^(-3/2).
double self_solid_fraction(double volume, double width);

/// The volume of the body, spread by the Gaussian, displaces fluid as it moves at v through fluid of velocity
/// u. To first order in eps_p = V G: div u' = -(v - u) . grad eps_p, so u'(k) = -(kk/k^2)(v - u) eps_p(k), a
/// potential flow whose mean at the body is, by isotropy, -(v - u) eps_p/3: the fluid is seen to flow
/// backwards, the slip u - v too large by the factor 1 + eps_p/3.
Vec3 displacement_self_velocity(const Vec3& slip, double volume, double width);

/// The slip u - v without the body's own steady disturbance, from the slip measured by averaging [m/s]:
///   measured = W (1 + eps_p/3) - k(|W|) W M(s |W|/nu)/(mu s).
/// `exchange` gives the drag coefficient k [kg/s] at a slip speed; `volume` 0 leaves the displacement out.
/// Errors: RunError when no slip answers, because the Gaussian is so narrow (s below about 0.4 d) that the
/// spread force moves more fluid than the body itself.
Vec3 undisturbed_slip(const Vec3& measured_slip, const std::function<double(double)>& exchange, double volume,
                      double width, const CarrierFluid& fluid);

}  // namespace seedflow
