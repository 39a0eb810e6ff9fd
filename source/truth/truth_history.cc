#include "truth_history.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "seedflow/base/error.h"
#include "truth_forces.h"

namespace seedflow {
namespace {

/// Integral over every earlier step of the kernel
///   K(s) = s^-1/2 (1 + sqrt(B) A^-1/4 s^3/4)^-2,  A = pi nu/R^2,  B = pi/2 |w|^3/(R nu f_H^3),
///   f_H = 0.75 + 0.105 Re.
/// In y = sqrt(s) it is smooth: three Gauss points a step, whose y^3/2 are tabulated by the age of the step.
class KernelTable {
 public:
  KernelTable(double step, int steps) : length(steps), points(steps) {
    const std::array<double, 3> x = {0.5 - 0.5 * std::sqrt(0.6), 0.5, 0.5 + 0.5 * std::sqrt(0.6)};
    for (int j = 0; j < steps; ++j) {
      const double from = std::sqrt(j * step), to = std::sqrt((j + 1) * step);
      length[j] = to - from;
      for (int p = 0; p < 3; ++p) points[j][p] = std::pow(from + x[p] * length[j], 1.5);
    }
  }
  /// Over ages from j to j + 1 steps [s^1/2].
  double integral(int j, double decay) const {
    const auto value = [&](int p) {
      const double x = 1 + decay * points[j][p];
      return 2 / (x * x);
    };
    return length[j] * (5 * value(0) + 8 * value(1) + 5 * value(2)) / 18;
  }

 private:
  std::vector<double> length;
  std::vector<std::array<double, 3>> points;
};

double decay(const TruthSeed& s, double speed) {
  const double nu = s.viscosity / s.fluid_density, r = 0.5 * s.diameter;
  const double f_h = 0.75 + 0.105 * s.diameter * speed / nu;
  return std::sqrt(0.5 * M_PI * std::pow(speed / f_h, 3) / (r * nu)) / std::pow(M_PI * nu / (r * r), 0.25);
}

}  // namespace

std::vector<TruthState> truth_states_with_history(const TruthSeed& seed, const std::vector<double>& times,
                                                  int steps) {
  if (times.empty()) return {};
  const Vec3 first_slip = seed.flow.velocity(seed.position, 0) - seed.velocity;
  if (norm(first_slip) > 1e-12)
    throw InputError("The truth generator wants a seed with a history force to start with the flow.");
  const double h = times.back() / steps;
  const double mass = truth_moving_mass(seed), inertia = 0.1 * seed.mass() * seed.diameter * seed.diameter;
  const double strength = seed.amplitude("History force") * 1.5 * seed.diameter * seed.diameter *
                          std::sqrt(M_PI * seed.fluid_density * seed.viscosity);
  const KernelTable table(h, steps);

  TruthState now{seed.position, seed.velocity, seed.spin};
  Vec3 acceleration = (truth_forces(seed, now, 0).force + seed.mass() * seed.gravity) / mass;
  Vec3 slip = first_slip;
  std::vector<Vec3> changes;  // of the slip, per time, in every step so far
  std::vector<TruthState> all = {now};
  for (int n = 0; n < steps; ++n) {
    const double t = (n + 1) * h;
    const Vec3 turn = truth_forces(seed, now, n * h).torque / inertia;
    TruthState next = now;
    Vec3 guess = acceleration, change;
    for (int iteration = 0; iteration < 100; ++iteration) {
      next.velocity = now.velocity + (0.5 * h) * (acceleration + guess);
      next.position = now.position + (0.5 * h) * (now.velocity + next.velocity);
      const TruthForces f = truth_forces(seed, next, t);
      next.spin = now.spin + (0.5 * h) * (turn + f.torque / inertia);
      const Vec3 next_slip = seed.flow.velocity(next.position, t) - next.velocity;
      const double fall = decay(seed, norm(next_slip));
      Vec3 past;
      for (int j = 0; j < n; ++j) past += table.integral(n - j, fall) * changes[j];
      const double newest = strength * table.integral(0, fall);
      // The part of the newest step that holds the unknown acceleration goes to the left-hand side.
      const Vec3 known = next_slip + (0.5 * h) * guess;
      const Vec3 load =
          f.force + seed.mass() * seed.gravity + strength * past + (newest / h) * (known - slip);
      const Vec3 better = load / (mass + 0.5 * newest);
      const double moved = norm(better - guess);
      guess = better;
      change = (next_slip - slip) / h;
      if (moved <= 1e-11 * norm(guess)) break;
      if (iteration == 99) throw RunError("Truth: the step with history does not converge; use more steps.");
    }
    changes.push_back(change);
    slip = seed.flow.velocity(next.position, t) - next.velocity;
    acceleration = guess;
    now = next;
    all.push_back(now);
  }

  // Cubic Hermite would need the accelerations; the steps are far shorter than anything that happens in them,
  // so a parabola through three states is enough.
  std::vector<TruthState> states;
  for (const double time : times) {
    const int i = std::clamp(static_cast<int>(std::lround(time / h)), 1, steps - 1);
    const double x = time / h - i;
    const double w[3] = {0.5 * x * (x - 1), 1 - x * x, 0.5 * x * (x + 1)};
    TruthState s;
    for (int j = 0; j < 3; ++j) {
      s.position += w[j] * all[i - 1 + j].position;
      s.velocity += w[j] * all[i - 1 + j].velocity;
      s.spin += w[j] * all[i - 1 + j].spin;
    }
    states.push_back(s);
  }
  return states;
}

}  // namespace seedflow
