#pragma once

#include <iosfwd>
#include <string>
#include <utility>
#include <vector>

#include "seedflow/base/parameters.h"
#include "seedflow/effects/single_body.h"
#include "seedflow/experiment/experiment.h"
#include "seedflow/fluid/prescribed_air.h"

namespace seedflow {

/// One seed, described by its volume-equivalent sphere, in a flow known beforehand: see SingleBody for the
/// equation of motion. A run costs milliseconds.
struct SingleSeedParameters {
  std::string name = "single seed";
  SingleBodyProperties seed{4e-3, 1340, 1};
  Vec3 position, velocity, spin;  ///< at the release [m], [m/s], [rad/s]
  double release_time = 0;        ///< [s]
  double density = 1000, viscosity = 1e-3, void_fraction = 1;
  Vec3 gravity{0, 0, -9.81};
  PrescribedAirParameters flow;
  double tube_diameter = 0;        ///< [m]; 0: none
  std::vector<std::string> walls;  ///< faces of the box that are there
  Vec3 lower{-0.05, -0.05, 0}, upper{0.05, 0.05, 0.2};
  double end_time = 0.2, time_step = 1e-3, series_interval = 1e-3;
  EffectSet effects;

  void declare(Parameters& parameters);
  /// Cross-checks, after Parameters::read(). Throws InputError.
  void check(const Parameters& parameters);
  /// The number behind a path like "Seeds/Diameter" or "Effects/Added mass/Strength"; null if there is none.
  /// Components of vectors: "Seeds/Spin x".
  double* number(const std::string& path);
  /// As number(), for reading and writing, effects included. InputError if there is no such number.
  double value(const std::string& path) const;
  void set(const std::string& path, double value);
};

/// What is known of a single seed at one time.
struct SingleSeedSample {
  SingleBodyState state;
  FlowAtBody flow;
};

/// Samples at rising times [s]; before the release the seed stays where it starts. `idle`, if given, receives
/// the names of effects that are on and added nothing.
std::vector<SingleSeedSample> run_single_seed(const SingleSeedParameters& parameters,
                                              const std::vector<double>& times,
                                              std::vector<std::string>* idle = nullptr,
                                              const std::function<void(const EffectSet&)>& look = nullptr);

/// C_D = F/(pi/8 rho d^2 w^2) of the seed held in a uniform stream of Reynolds number `reynolds` = rho d
/// w/mu, from all effects that act on steady motion.
double single_seed_drag_coefficient(const SingleSeedParameters& parameters, double reynolds);

/// Quantities: velocity (along gravity), velocity x|y|z, position x|y|z, fall, spin x|y|z, Reynolds number,
/// wall gap, relative acceleration over time [s]; terminal velocity without coordinate; drag coefficient over
/// Reynolds number [1].
Observer single_seed_observer();

/// Experiment "single seed".
int run_single_seed_experiment(const RunOptions& options);
void describe_single_seed(std::ostream& out, const std::string& section);

}  // namespace seedflow
