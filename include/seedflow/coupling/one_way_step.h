#pragma once

#include <iosfwd>

#include "seedflow/coupling/body_loads.h"
#include "seedflow/fluid/prescribed_air.h"

namespace seedflow {

/// One step of seeds in a prescribed flow: the air does not feel them, and each body sees the flow at its
/// centre.
class OneWayStep {
 public:
  OneWayStep(const CouplingParameters& parameters, PrescribedAir& flow, Dem& dem, EffectSet& effects,
             const AirProperties& air, const Vec3& gravity)
      : flow(flow), dem(dem), all_bodies(dem, parameters), body_loads(effects, air, gravity) {}

  void advance(double dt);

  const Bodies& bodies() const { return all_bodies; }
  BodyLoads& loads() { return body_loads; }
  const AirAtBodies& air_at_bodies() const { return seen; }
  /// Force of the air on each body over the last step, buoyancy included [N].
  const std::vector<Vec3>& force_on_bodies() const { return body_force; }

  void save(std::ostream& out) const { body_loads.save(out); }
  void load(std::istream& in) { body_loads.load(in); }

 private:
  PrescribedAir& flow;
  Dem& dem;
  Bodies all_bodies;
  BodyLoads body_loads;
  AirAtBodies seen;
  std::vector<Vec3> body_force;
};

}  // namespace seedflow
