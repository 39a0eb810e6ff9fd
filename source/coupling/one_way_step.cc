#include "seedflow/coupling/one_way_step.h"

namespace seedflow {

void OneWayStep::advance(double dt) {
  all_bodies.update(dem);
  const std::size_t n = all_bodies.size();
  const double time = dem.time();
  seen = {std::vector<Vec3>(n), std::vector<Vec3>(n), std::vector<Vec3>(n), std::vector<Vec3>(n),
          std::vector<double>(n, 1.0)};
  std::vector<Vec3> velocity_ahead(n);  // the mean over the step, to second order
  for (std::size_t b = 0; b < n; ++b) {
    const FlowAtPoint point = flow.at(all_bodies.position[b], time);
    seen.velocity[b] = point.velocity;
    seen.vorticity[b] = point.vorticity;
    seen.acceleration[b] = point.acceleration;
    seen.pressure_gradient[b] = point.pressure_gradient;
    velocity_ahead[b] =
        flow.velocity(all_bodies.position[b] + 0.5 * dt * all_bodies.velocity[b], time + 0.5 * dt);
  }
  body_loads.evaluate(all_bodies, seen, dem, time, dt);
  dem.set_loads(all_bodies.share_loads(body_loads.force, velocity_ahead));
  dem.advance(dt);

  std::vector<Vec3> on_spheres;
  dem.fluid_impulses(on_spheres);
  body_force = all_bodies.sum(on_spheres);
  for (std::size_t b = 0; b < n; ++b) body_force[b] = body_force[b] / dt + body_loads.force[b].force;
}

}  // namespace seedflow
