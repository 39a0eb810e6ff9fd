#pragma once

#include <vector>

#include "seedflow/coupling/coupling_parameters.h"
#include "seedflow/effects/slots.h"
#include "seedflow/seeds/dem.h"

namespace seedflow {

/// One thing the air drags: a sub-sphere, or a whole seed.
struct Body {
  int seed = 0;
  int first = 0, last = 0;    ///< its sub-spheres are first .. last - 1
  double diameter = 0;        ///< the drag law's diameter [m]
  double mass = 0;            ///< [kg]
  double solid_volume = 0;    ///< taken from the air [m3]
  double buoyant_volume = 0;  ///< of the pressure-gradient force and the added mass [m3]
  double sphericity = 1;      ///< [1]
};

/// The dragged bodies of all seeds and their present motion; every rank holds all of them.
/// Within a body, loads are shared over the sub-spheres in proportion to their mass, so that a load on a seed
/// accelerates it as a whole and strains no bond.
class Bodies {
 public:
  Bodies(const Dem& dem, const CouplingParameters& parameters);

  /// Reads positions and velocities from the seeds.
  void update(const Dem& dem);

  std::size_t size() const { return body.size(); }
  const Body& operator[](std::size_t b) const { return body[b]; }
  const std::vector<Body>& all() const { return body; }

  std::vector<Vec3> position;          ///< [m]
  std::vector<Vec3> velocity;          ///< mean over the mass [m/s]
  std::vector<Vec3> angular_velocity;  ///< [rad/s]
  const std::vector<Vec3>& sphere_position() const { return sphere_positions; }

  /// Share of sub-sphere s in its body.
  double share(std::size_t s) const { return mass_share[s]; }
  std::size_t n_spheres() const { return mass_share.size(); }
  double sphere_radius(std::size_t s) const { return radius[s]; }

  /// Loads on the bodies as loads on their sub-spheres; flow_velocity is the one the drag coefficients refer
  /// to.
  SphereLoads share_loads(const std::vector<BodyForce>& force, const std::vector<Vec3>& flow_velocity) const;

  /// Sums a quantity of the sub-spheres over each body.
  std::vector<Vec3> sum(const std::vector<Vec3>& of_spheres) const;

 private:
  std::vector<Body> body;
  std::vector<double> mass_share, radius;
  std::vector<Vec3> sphere_positions, sphere_velocities, sphere_spins;
};

}  // namespace seedflow
