#include "seedflow/seeds/rigid_load.h"

// GCC 12 reports its own AVX-512 header as using uninitialised values (GCC bug 105593).
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace seedflow {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;
using Vector6 = Eigen::Matrix<double, 6, 1>;

// D^T D of a point at r, times s.
void add_point(Matrix6& a, const Vec3& r, double s) {
  Eigen::Matrix<double, 3, 6> d;
  d << 1, 0, 0, 0, r.z, -r.y,  //
      0, 1, 0, -r.z, 0, r.x,   //
      0, 0, 1, r.y, -r.x, 0;
  a += s * d.transpose() * d;
}

double phi_2(double z) {
  return z < 1e-3 ? 0.5 - z / 6 + z * z / 24 - z * z * z / 120 : (z + std::expm1(-z)) / (z * z);
}

Vector6 six(const Vec3& a, const Vec3& b) {
  return (Vector6() << a.x, a.y, a.z, b.x, b.y, b.z).finished();
}

}  // namespace

RigidLoad reduce_loads(const SeedTemplate& model, const LoadLanes* loads, int lane, double step) {
  RigidLoad r{};
  Matrix6 mass = Matrix6::Zero(), drag = Matrix6::Zero();
  mass.diagonal() << model.mass, model.mass, model.mass, model.inertia.x, model.inertia.y, model.inertia.z;
  bool forces_alone = true;
  for (int i = 0; i < model.n_spheres(); ++i) {
    const LoadLanes& l = loads[i];
    const Vec3& arm = model.position[i];
    if (l.added_mass[lane] != 0 || l.drag[lane] != 0) {
      forces_alone = false;
      add_point(mass, arm, l.added_mass[lane]);
      add_point(drag, arm, l.drag[lane]);
    }
    const Vec3 push = l.force.get(lane) + l.drag[lane] * l.flow.get(lane);
    r.force += push;
    r.torque += l.torque.get(lane);
    for (int c = 0; c < 3; ++c) r.moment[c] += arm[c] * push;
  }
  if (forces_alone) {  // K = 0: X X^T = M^-1 is diagonal and phi_2(0) = 1/2
    const Matrix6 inverse = mass.diagonal().cwiseInverse().asDiagonal();
    Eigen::Map<Matrix6>(r.mobility) = inverse;
    Eigen::Map<Matrix6>(r.mean_half) = Eigen::Map<Matrix6>(r.mean_full) = 0.5 * inverse;
    return r;
  }
  const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix6> solver(drag, mass);
  const Matrix6 x = solver.eigenvectors();
  const auto spectral = [&](double h) {
    Vector6 f;
    for (int k = 0; k < 6; ++k) f[k] = phi_2(h * std::max(0.0, solver.eigenvalues()[k]));
    return Matrix6(x * f.asDiagonal() * x.transpose());
  };
  Eigen::Map<Matrix6>(r.drag) = drag;
  Eigen::Map<Matrix6>(r.mobility) = x * x.transpose();
  Eigen::Map<Matrix6>(r.mean_half) = spectral(0.5 * step);
  Eigen::Map<Matrix6>(r.mean_full) = spectral(step);
  return r;
}

void kick_reduced(RigidLoad& load, const Quaternion& orientation, const Vec3& force, const Vec3& torque,
                  double h, bool half, Vec3& velocity, Vec3& spin) {
  const Vec3 axis[3] = {rotate(orientation, {1, 0, 0}), rotate(orientation, {0, 1, 0}),
                        rotate(orientation, {0, 0, 1})};
  Vec3 turning = torque + load.torque;
  for (int c = 0; c < 3; ++c) turning += cross(axis[c], load.moment[c]);
  const Vector6 g = six(rotate_back(orientation, force + load.force), rotate_back(orientation, turning));
  const Vector6 v = six(rotate_back(orientation, velocity), rotate_back(orientation, spin));
  const Eigen::Map<const Matrix6> drag(load.drag), mobility(load.mobility),
      mean(half ? load.mean_half : load.mean_full);
  const Vector6 average = v + h * (mean * (g - drag * v));
  const Vector6 change = h * (mobility * (g - drag * average));
  const auto part = [&](const Vector6& a, int k) { return rotate(orientation, {a[k], a[k + 1], a[k + 2]}); };
  const Vec3 mean_velocity = part(average, 0), mean_spin = part(average, 3);
  const Vec3 dv = part(change, 0), dw = part(change, 3);
  load.path += h * mean_velocity;
  load.change += dv;
  for (int c = 0; c < 3; ++c) {
    load.path_arm[c] += h * cross(mean_spin, axis[c]);
    load.change_arm[c] += cross(dw, axis[c]);
  }
  velocity += dv;
  spin += dw;
}

void spread_impulses(const RigidLoad& load, const SeedTemplate& model, LoadLanes* loads, int lane,
                     double duration) {
  for (int i = 0; i < model.n_spheres(); ++i) {
    LoadLanes& l = loads[i];
    Vec3 path = load.path, change = load.change;
    for (int c = 0; c < 3; ++c) {
      path += model.position[i][c] * load.path_arm[c];
      change += model.position[i][c] * load.change_arm[c];
    }
    l.impulse.set(lane, l.drag[lane] * (duration * l.flow.get(lane) - path) - l.added_mass[lane] * change);
  }
}

}  // namespace seedflow
