#pragma once

#include <optional>
#include <vector>

#include "seedflow/base/device_geometry.h"
#include "seedflow/coupling/body_loads.h"
#include "seedflow/coupling/covered_hole.h"
#include "seedflow/coupling/suction_parameters.h"

namespace seedflow {

/// A hole of the turning disc at the end of the last step.
struct HoleState {
  double angle = 0;     ///< [rad], not reduced to one turn
  double exposure = 0;  ///< part that opens into the vacuum [1]
  double cover = 0;     ///< chi, the part of the vacuum that stands under the seeds [1]
  double flow = 0;      ///< [m3/s]
};

/// What the air does to one seed, mean over the last advance().
struct SeedLoad {
  Vec3 pressure, drag;  ///< [N]; drag includes all effects but the suction's pressure
};

/// Seeds and the air drawn through the holes of a metering disc, without an air mesh ("hole sinks"). Every
/// hole that faces the vacuum is an opening with the potential flow of aperture_velocity() and, where seeds
/// are near, the pressure and throttling of CoveredHole. The fields of the holes are added; chambers and the
/// seeds' own wakes do not exist in it.
///
/// The air's velocity at a body (whole seed or sub-sphere, Coupling/Drag on) goes into the effects (drag,
/// Eqs. 6-7, ...). The pressure force is that of CoveredHole times the strength of the effect "Pressure
/// gradient"; the effect itself sees no pressure gradient but the hydrostatic one, so that nothing counts
/// twice. All forces are held over a step (drag too: k dt/m is below 1e-3 for any seed).
///
/// A hole's velocity fades out smoothly between 3 and 4 pitch lengths of the holes, where it is below 0.04
/// m/s for 3 kPa (drag on a seed: 1e-4 of its weight).
class SuctionStep {
 public:
  /// \param disc the wall that turns about the z axis and carries the holes. \param seed_radius of the ball
  /// that stands for a seed at a hole [m].
  SuctionStep(const SuctionParameters& parameters, const DeviceGeometry& device,
              const CouplingParameters& coupling, int disc, double seed_radius, EffectSet& effects,
              const Vec3& gravity);

  /// Advances the seeds, in steps of the air. Returns the impulse of the air on all seeds [N s].
  Vec3 advance(Dem& dem, double duration);

  const std::vector<HoleState>& holes() const { return hole; }
  const std::vector<SeedLoad>& seed_loads() const { return mean_load; }
  /// Of the vacuum chamber: drop [Pa] and flow through fan and line [m3/s].
  const SuctionBalance& chamber() const { return balance; }
  double leak_flow() const { return leak; }                 ///< [m3/s]
  double largest_flow_error() const { return flow_error; }  ///< sum of holes and leak against fan, relative
  /// Integrals over time since the start: volume of air drawn [m3], work of the vacuum on it [J].
  double air_drawn() const { return volume; }
  double work() const { return energy; }

  void save(std::ostream& out) const;
  void load(std::istream& in);

 private:
  void look(const Dem& dem);
  Vec3 step(Dem& dem, double dt);
  Vec3 velocity_at(const Vec3& x) const;

  SuctionParameters parameters;
  DeviceGeometry device;
  CouplingParameters coupling;
  int disc;
  CoveredHole law;
  EffectSet& effects;
  BodyLoads body_loads;
  std::optional<Bodies> bodies;
  std::vector<HoleState> hole;
  std::vector<Vec3> mouth;  ///< [hole] lab frame [m]
  std::vector<SeedLoad> seed_load, mean_load;
  SuctionBalance balance;
  double leak = 0, flow_error = 0, volume = 0, energy = 0;
};

}  // namespace seedflow
