#include "seedflow/seeds/template_inertia.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <sstream>

#include "seedflow/base/error.h"

namespace seedflow {

void match_real_inertia(SeedTemplate& seed, const Shape& shape) {
  seed.relative_density.clear();
  seed.finish();
  const int n = seed.n_spheres();
  const double length = 0.5 * seed.equivalent_diameter;

  // Conditions on the mass shares m_i / M, in units of the seed's mean radius, in the shape's own axes.
  Eigen::MatrixXd condition(10, n);
  Eigen::VectorXd share(n), goal(10);
  for (int i = 0; i < n; ++i) {
    const Vec3 x = rotate_back(seed.seed_frame, seed.position[i] - seed.seed_centre) / length;
    const double own = 0.2 * std::pow(seed.radius[i] / length, 2);
    share[i] = seed.sphere_mass[i] / seed.mass;
    condition.col(i) << 1, x.x, x.y, x.z, x.x * x.x + own, x.y * x.y + own, x.z * x.z + own, x.x * x.y,
        x.x * x.z, x.y * x.z;
  }
  const Vec3 s = shape.second_moment / (length * length);
  goal << 1, 0, 0, 0, s.x, s.y, s.z, 0, 0, 0;

  const Eigen::VectorXd miss = goal - condition * share;
  const Eigen::MatrixXd system = condition * share.asDiagonal() * condition.transpose();
  const Eigen::VectorXd multiplier = system.completeOrthogonalDecomposition().solve(miss);
  const Eigen::VectorXd change = condition.transpose() * multiplier;
  const double left = (miss - system * multiplier).norm();
  if (!(left < 1e-10) || !(change.minCoeff() > -1)) {
    std::ostringstream message;
    message << "Seed template '" << seed.name << "': the inertia of the real seed cannot be reached with its "
            << n << " sub-spheres ";
    if (left < 1e-10)
      message << "(a sub-sphere would need " << 1 + change.minCoeff() << " times its mass). ";
    else
      message << "(no distribution of mass over them has it). ";
    message << "Use more sub-spheres, smaller ones that reach the surface, or 'Real inertia = false'.";
    throw InputError(message.str());
  }
  seed.relative_density.resize(n);
  for (int i = 0; i < n; ++i) seed.relative_density[i] = 1 + change[i];
  seed.finish();
}

}  // namespace seedflow
