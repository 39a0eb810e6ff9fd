#include "seedflow/seeds/seed_template.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "seedflow/base/error.h"

namespace seedflow {
namespace {

bool finite(const Vec3& a) {
  return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}

void check(const SeedTemplate& t) {
  const auto reject = [&](const std::string& reason) {
    throw InputError("Seed template '" + t.name + "': " + reason);
  };
  const auto positive = [](double a) { return std::isfinite(a) && a > 0; };
  const std::size_t n = t.position.size();
  if (n == 0) reject("it has no sub-spheres; at least one is needed.");
  if (t.radius.size() != n)
    reject(std::to_string(n) + " positions but " + std::to_string(t.radius.size()) +
           " radii; give one of each.");
  if (!t.relative_density.empty() && t.relative_density.size() != n)
    reject("relative_density must be empty or have one number per sub-sphere.");
  for (std::size_t i = 0; i < n; ++i) {
    const std::string sphere = "sub-sphere " + std::to_string(i);
    if (!finite(t.position[i])) reject("the position of " + sphere + " is not finite.");
    if (!positive(t.radius[i])) reject("the radius of " + sphere + " must be finite and positive (m).");
    if (!t.relative_density.empty() && !positive(t.relative_density[i]))
      reject("the relative density of " + sphere + " must be finite and positive.");
  }
  if (!positive(t.seed_volume)) reject("the volume of the seed must be finite and positive (m3).");
  if (!positive(t.seed_density)) reject("the density of the seed must be finite and positive (kg/m3).");
  for (const Bond& b : t.bond) {
    const std::string name = "the bond " + std::to_string(b.first) + "-" + std::to_string(b.second);
    if (b.first < 0 || b.second <= b.first || b.second >= t.n_spheres())
      reject(name + " must join two sub-spheres first < second out of 0.." + std::to_string(n - 1) + ".");
    if (!positive(b.radius)) reject("the radius of " + name + " must be finite and positive (m).");
  }
}

Eigen::Matrix3d inertia_tensor(const SeedTemplate& t) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (int i = 0; i < t.n_spheres(); ++i) {
    const Eigen::Vector3d x(t.position[i].x, t.position[i].y, t.position[i].z);
    sum += t.sphere_mass[i] * (x.squaredNorm() * Eigen::Matrix3d::Identity() - x * x.transpose());
    sum.diagonal().array() += t.sphere_inertia[i];
  }
  return sum;
}

double outermost(const SeedTemplate& t) {
  double reach = 0;
  for (int i = 0; i < t.n_spheres(); ++i) reach = std::max(reach, norm(t.position[i]) + t.radius[i]);
  return reach;
}

constexpr double round_off = 1e-12;

bool is_principal(const Eigen::Matrix3d& inertia) {
  const double small = round_off * inertia.trace();
  return std::abs(inertia(0, 1)) < small && std::abs(inertia(0, 2)) < small &&
         std::abs(inertia(1, 2)) < small && inertia(0, 0) <= inertia(1, 1) + small &&
         inertia(1, 1) <= inertia(2, 2) + small;
}

void turn_into_principal_axes(SeedTemplate& t, const Eigen::Matrix3d& inertia) {
  Eigen::Matrix3d axes = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(inertia).eigenvectors();
  // Eigenvectors have no sign: the largest component of the first two is made positive, the third completes a
  // right-handed frame.
  for (int a = 0; a < 2; ++a) {
    int largest;
    axes.col(a).cwiseAbs().maxCoeff(&largest);
    if (axes(largest, a) < 0) axes.col(a) *= -1;
  }
  axes.col(2) = axes.col(0).cross(axes.col(1));
  const Eigen::Quaterniond q(Eigen::Matrix3d(axes.transpose()));
  const Quaternion turn = normalized({q.w(), {q.x(), q.y(), q.z()}});
  for (Vec3& x : t.position) x = rotate(turn, x);
  t.seed_centre = rotate(turn, t.seed_centre);
  t.seed_frame = normalized(turn * t.seed_frame);
}

}  // namespace

void SeedTemplate::finish() {
  check(*this);
  const int n = n_spheres();
  mass = seed_density * seed_volume;
  equivalent_diameter = std::cbrt(6.0 * seed_volume / M_PI);

  std::vector<double> weight(n);
  double total = 0;
  for (int i = 0; i < n; ++i) {
    weight[i] = radius[i] * radius[i] * radius[i] * (relative_density.empty() ? 1.0 : relative_density[i]);
    total += weight[i];
  }
  sphere_mass.resize(n);
  sphere_inertia.resize(n);
  Vec3 centre;
  for (int i = 0; i < n; ++i) {
    sphere_mass[i] = mass * (weight[i] / total);
    sphere_inertia[i] = 0.4 * sphere_mass[i] * radius[i] * radius[i];
    centre += (weight[i] / total) * position[i];
  }

  if (norm(centre) > round_off * outermost(*this)) {
    for (Vec3& x : position) x -= centre;
    seed_centre -= centre;
  }
  Eigen::Matrix3d tensor = inertia_tensor(*this);
  if (!is_principal(tensor)) {
    turn_into_principal_axes(*this, tensor);
    tensor = inertia_tensor(*this);
  }
  inertia = {tensor(0, 0), tensor(1, 1), tensor(2, 2)};
  bounding_radius = outermost(*this);
}

}  // namespace seedflow
