#include "seedflow/coupling/bodies.h"

#include <cmath>

namespace seedflow {

namespace {

double sphere_volume(double radius) {
  return 4.0 / 3.0 * M_PI * radius * radius * radius;
}

/// Surface of the sphere of equal volume over the surface of the ellipsoid (Knud Thomsen's approximation,
/// p = 1.6075, relative error below 1.061 %).
double ellipsoid_sphericity(const Vec3& a) {
  if (!(a.x > 0 && a.y > 0 && a.z > 0)) return 1.0;
  const double p = 1.6075;
  const double ab = std::pow(a.x * a.y, p), ac = std::pow(a.x * a.z, p), bc = std::pow(a.y * a.z, p);
  return std::pow(a.x * a.y * a.z, 2.0 / 3.0) / std::pow((ab + ac + bc) / 3.0, 1.0 / p);
}

}  // namespace

Bodies::Bodies(const Dem& dem, const CouplingParameters& parameters) {
  const bool per_seed = parameters.drag_on == "seed";
  for (int seed = 0; seed < dem.n_seeds(); ++seed) {
    const SeedTemplate& model = dem.seed_template(seed);
    const int first = dem.first_sphere(seed), last = dem.first_sphere(seed + 1);
    double spheres_volume = 0;
    for (int s = first; s < last; ++s) spheres_volume += sphere_volume(dem.radii()[s]);
    const double solid = parameters.solid_volume == "seed" ? model.seed_volume : spheres_volume;
    const double buoyant = parameters.buoyancy_volume == "seed"          ? model.seed_volume
                           : parameters.buoyancy_volume == "sub-spheres" ? spheres_volume
                                                                         : 0.0;
    if (per_seed) {
      body.push_back({seed, first, last, model.equivalent_diameter, model.mass, solid, buoyant,
                      ellipsoid_sphericity(model.seed_semi_axes)});
    } else {
      for (int s = first; s < last; ++s) {
        const double part = sphere_volume(dem.radii()[s]) / spheres_volume;
        body.push_back(
            {seed, s, s + 1, 2 * dem.radii()[s], dem.masses()[s], part * solid, part * buoyant, 1.0});
      }
    }
  }
  radius = dem.radii();
  mass_share.resize(dem.n_spheres());
  for (const Body& b : body)
    for (int s = b.first; s < b.last; ++s) mass_share[s] = dem.masses()[s] / b.mass;
  update(dem);
}

void Bodies::update(const Dem& dem) {
  dem.positions(sphere_positions);
  dem.velocities(sphere_velocities);
  dem.angular_velocities(sphere_spins);
  position.assign(body.size(), Vec3());
  velocity.assign(body.size(), Vec3());
  angular_velocity.assign(body.size(), Vec3());
  for (std::size_t b = 0; b < body.size(); ++b) {
    for (int s = body[b].first; s < body[b].last; ++s) {
      position[b] += mass_share[s] * sphere_positions[s];
      velocity[b] += mass_share[s] * sphere_velocities[s];
    }
    const bool whole_seed = body[b].last - body[b].first > 1;
    angular_velocity[b] = whole_seed ? dem.seed_state(body[b].seed).spin : sphere_spins[body[b].first];
  }
}

SphereLoads Bodies::share_loads(const std::vector<BodyForce>& force,
                                const std::vector<Vec3>& flow_velocity) const {
  SphereLoads loads;
  loads.force.resize(n_spheres());
  loads.torque.resize(n_spheres());
  loads.drag_coefficient.resize(n_spheres());
  loads.flow_velocity.resize(n_spheres());
  loads.added_mass.resize(n_spheres());
  for (std::size_t b = 0; b < body.size(); ++b)
    for (int s = body[b].first; s < body[b].last; ++s) {
      loads.force[s] = mass_share[s] * force[b].force;
      loads.torque[s] = mass_share[s] * force[b].torque;
      loads.drag_coefficient[s] = mass_share[s] * force[b].drag_coefficient;
      loads.flow_velocity[s] = flow_velocity[b];
      loads.added_mass[s] = mass_share[s] * force[b].added_mass;
    }
  return loads;
}

std::vector<Vec3> Bodies::sum(const std::vector<Vec3>& of_spheres) const {
  std::vector<Vec3> result(body.size());
  for (std::size_t b = 0; b < body.size(); ++b)
    for (int s = body[b].first; s < body[b].last; ++s) result[b] += of_spheres[s];
  return result;
}

}  // namespace seedflow
