#include "seedflow/truth/truth_seed.h"

#include <algorithm>
#include <cmath>

#include "seedflow/base/error.h"
#include "truth_forces.h"
#include "truth_history.h"

namespace seedflow {
namespace {

constexpr int size = 9;
using Numbers = std::array<double, size>;

TruthState state_of(const Numbers& y) {
  return {{y[0], y[1], y[2]}, {y[3], y[4], y[5]}, {y[6], y[7], y[8]}};
}

Numbers numbers_of(const TruthState& s) {
  return {s.position.x, s.position.y, s.position.z, s.velocity.x, s.velocity.y,
          s.velocity.z, s.spin.x,     s.spin.y,     s.spin.z};
}

Numbers rates(const TruthSeed& seed, const Numbers& y, double t) {
  const TruthState state = state_of(y);
  const TruthForces f = truth_forces(seed, state, t);
  const Vec3 a = (f.force + seed.mass() * seed.gravity) / truth_moving_mass(seed);
  const Vec3 turn = f.torque / (0.1 * seed.mass() * seed.diameter * seed.diameter);
  return {y[3], y[4], y[5], a.x, a.y, a.z, turn.x, turn.y, turn.z};
}

// Dormand & Prince (1980), J. Comput. Appl. Math. 6, 19-26, doi:10.1016/0771-050X(80)90013-3.
constexpr double nodes[7] = {0, 1.0 / 5, 3.0 / 10, 4.0 / 5, 8.0 / 9, 1, 1};
constexpr double stages[7][6] = {{},
                                 {1.0 / 5},
                                 {3.0 / 40, 9.0 / 40},
                                 {44.0 / 45, -56.0 / 15, 32.0 / 9},
                                 {19372.0 / 6561, -25360.0 / 2187, 64448.0 / 6561, -212.0 / 729},
                                 {9017.0 / 3168, -355.0 / 33, 46732.0 / 5247, 49.0 / 176, -5103.0 / 18656},
                                 {35.0 / 384, 0, 500.0 / 1113, 125.0 / 192, -2187.0 / 6784, 11.0 / 84}};
/// Order 5 minus order 4.
constexpr double difference[7] = {71.0 / 57600,      0,          -71.0 / 16695, 71.0 / 1920,
                                  -17253.0 / 339200, 22.0 / 525, -1.0 / 40};

/// One step; returns the estimated error over what is allowed.
double dormand_prince_step(const TruthSeed& seed, const Numbers& y, double t, double h,
                           const Numbers& allowed, Numbers& next) {
  Numbers k[7];
  k[0] = rates(seed, y, t);
  for (int s = 1; s < 7; ++s) {
    Numbers at = y;
    for (int j = 0; j < s; ++j)
      for (int i = 0; i < size; ++i) at[i] += h * stages[s][j] * k[j][i];
    k[s] = rates(seed, at, t + nodes[s] * h);
    if (s == 6) next = at;  // the weights of order 5 are the last stage's
  }
  double worst = 0;
  for (int i = 0; i < size; ++i) {
    double error = 0;
    for (int s = 0; s < 7; ++s) error += h * difference[s] * k[s][i];
    worst = std::max(worst, std::abs(error) / allowed[i]);
    if (!std::isfinite(next[i])) worst = 1e300;
  }
  return worst;
}

}  // namespace

std::vector<TruthState> truth_states(const TruthSeed& seed, const std::vector<double>& times,
                                     double tolerance, int history_steps) {
  for (const auto& [name, amplitude] : seed.amplitudes)
    if (std::find(truth_effects().begin(), truth_effects().end(), name) == truth_effects().end())
      throw InputError("The truth generator knows no effect '" + name + "'.");
  if (seed.amplitude("History force") != 0) return truth_states_with_history(seed, times, history_steps);

  Numbers y = numbers_of({seed.position, seed.velocity, seed.spin});
  double t = 0, h = times.empty() ? 0 : 1e-4 * times.back();
  // Allowed errors follow the largest value met so far.
  double speed = 1e-3 * seed.diameter / std::max(h, 1e-300) * 1e-4, spin = 0;
  std::vector<TruthState> states;
  for (const double target : times) {
    while (t < target) {
      speed = std::max({speed, std::abs(y[3]), std::abs(y[4]), std::abs(y[5])});
      spin = std::max({spin, std::abs(y[6]), std::abs(y[7]), std::abs(y[8])});
      Numbers allowed;
      for (int i = 0; i < size; ++i)
        allowed[i] = tolerance * (i < 3   ? seed.diameter
                                  : i < 6 ? speed
                                          : std::max(spin, speed / seed.diameter));
      const double step = std::min(h, target - t);
      Numbers next;
      const double error = dormand_prince_step(seed, y, t, step, allowed, next);
      if (error <= 1) t = step < h ? target : t + step, y = next;
      const double change = 0.9 * std::pow(std::max(error, 1e-10), -0.2);
      if (error > 1 || step == h) h = step * std::min(5.0, std::max(0.2, change));
      if (h < 1e-14 * times.back())
        throw RunError("Truth: the step size collapsed at t = " + std::to_string(t) + " s.");
    }
    states.push_back(state_of(y));
  }
  return states;
}

}  // namespace seedflow
