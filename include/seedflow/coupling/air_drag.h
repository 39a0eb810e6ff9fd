#pragma once

#include <iosfwd>

#include "seedflow/effects/effect.h"
#include "seedflow/seeds/dem.h"

namespace seedflow {

/// Air at rest around the seeds of an experiment that computes no air: the effect "Air drag"
/// (effects/model_effects.h) on every seed as a whole,
///
///   F = -k v,   k = strength 3 pi mu d f(rho d |v|/mu),
///
/// shared over the sub-spheres by mass as in coupled runs (so that the spin of a clump is damped too).
///
/// Implicit: k is held over at most 1 ms, the Dem integrates m dv/dt = ... - k v with the present v of every
/// substep. So no seed is too light for the step, a seed that rebounds within the step is braked in its new
/// direction, and the impulse of the air is known to the last bit. What is left is the change of k with the
/// speed within 1 ms.
class AirDrag {
 public:
  static constexpr double longest_step = 1e-3;  ///< [s]

  /// \param effect made from air_drag(). \param gravity for share_of_weight() [m/s2].
  AirDrag(const Effect& effect, const Vec3& gravity);

  /// Advances the seeds. Returns the impulse of the air on all of them [N s]. Collective like Dem::advance().
  Vec3 advance(Dem& dem, double duration);

  bool acted() const { return drag.activity().acted(); }
  /// Mean drag over mean weight of the seeds so far; 0 without gravity.
  double share_of_weight() const;
  const Vec3& impulse() const { return given; }  ///< to all seeds so far [N s]

  void save(std::ostream& out) const;
  void load(std::istream& in);

 private:
  Effect drag;
  double density, viscosity;
  Vec3 gravity, given;
  double weight = 0;  ///< of all seeds, summed over evaluations [N]
};

}  // namespace seedflow
