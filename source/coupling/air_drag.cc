#include "seedflow/coupling/air_drag.h"

#include <algorithm>
#include <cmath>

#include "seedflow/base/binary.h"
#include "seedflow/coupling/bodies.h"

namespace seedflow {

AirDrag::AirDrag(const Effect& effect, const Vec3& g)
    : drag(effect),
      density(effect.number("Density")),
      viscosity(effect.number("Dynamic viscosity")),
      gravity(g) {
  drag.prepare();
}

Vec3 AirDrag::advance(Dem& dem, double duration) {
  const long n = std::max(1L, std::lround(std::ceil(duration / longest_step - 1e-9)));
  const double dt = duration / static_cast<double>(n);
  Bodies seeds(dem, CouplingParameters());  // every seed is one body
  const std::vector<Vec3> at_rest(seeds.size());
  std::vector<BodyForce> force(seeds.size());
  std::vector<Vec3> on_spheres;
  Vec3 impulse;
  for (long i = 0; i < n; ++i) {
    seeds.update(dem);
    for (std::size_t b = 0; b < seeds.size(); ++b) {
      FlowAtBody flow;
      flow.body = dem.seed_label(seeds[b].seed);
      flow.time = dem.time();
      flow.time_step = dt;
      flow.diameter = seeds[b].diameter;
      flow.volume = seeds[b].solid_volume;
      flow.mass = seeds[b].mass;
      flow.sphericity = seeds[b].sphericity;
      flow.position = seeds.position[b];
      flow.velocity = seeds.velocity[b];
      flow.density = density;
      flow.viscosity = viscosity;
      flow.gravity = gravity;
      force[b] = BodyForce();
      drag.add(flow, force[b]);
      weight += seeds[b].mass * norm(gravity);
    }
    dem.set_loads(seeds.share_loads(force, at_rest));
    dem.advance(dt);
    dem.fluid_impulses(on_spheres);
    for (const Vec3& part : on_spheres) impulse += part;
  }
  given += impulse;
  return impulse;
}

double AirDrag::share_of_weight() const {
  return weight > 0 ? drag.activity().force / weight : 0;
}

void AirDrag::save(std::ostream& out) const {
  drag.save(out);
  write_binary(out, given);
  write_binary(out, weight);
}

void AirDrag::load(std::istream& in) {
  drag.load(in);
  read_binary(in, given);
  read_binary(in, weight);
}

}  // namespace seedflow
