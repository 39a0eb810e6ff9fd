#pragma once

#include <mpi.h>

#include <iosfwd>
#include <memory>
#include <optional>
#include <string>

#include "seedflow/coupling/coupled_step.h"
#include "seedflow/coupling/one_way_step.h"
#include "seedflow/experiment/simulation_parameters.h"
#include "seedflow/mesh/point_location.h"

namespace seedflow {

/// Air, seeds and their coupling, built from parameters. Many may live in one process.
class Simulation {
 public:
  /// The parameters must outlive the simulation and not move. Throws InputError (also for unstable time steps
  /// and seeds that overlap walls).
  Simulation(SimulationParameters& parameters, MPI_Comm comm);

  /// One air step of the given length [s].
  void advance(double dt);

  double time() const { return seeds.time(); }
  Dem& dem() { return seeds; }
  const Dem& dem() const { return seeds; }
  /// Null with prescribed air.
  Fluid<3>* fluid() { return air ? &*air : nullptr; }
  CoupledStep* coupled() { return two_way ? &*two_way : nullptr; }
  const Bodies& bodies() const { return two_way ? two_way->bodies() : one_way->bodies(); }
  const AirAtBodies& air_at_bodies() const {
    return two_way ? two_way->air_at_bodies() : one_way->air_at_bodies();
  }
  const std::vector<Vec3>& force_on_bodies() const {
    return two_way ? two_way->force_on_bodies() : one_way->force_on_bodies();
  }
  /// Summed over the bodies of a seed [N].
  Vec3 force_on_seed(int seed) const;
  std::size_t n_cells() const;
  const SimulationParameters& settings() const { return parameters; }
  MPI_Comm communicator() const { return comm; }

  /// What --dry-run prints.
  std::string describe() const;

  /// Largest change of the air's momentum by moving it to an adapted mesh, relative to its momentum.
  double momentum_change_by_adaptation() const { return adaptation_change; }

  /// \param mesh_prefix where the mesh is written to or read from (only meshes that are adapted).
  void save(std::ostream& seeds_out, std::ostream& air_out, std::ostream& coupling_out,
            const std::string& mesh_prefix) const;
  void load(std::istream& seeds_in, std::istream& air_in, std::istream& coupling_in,
            const std::string& mesh_prefix);

 private:
  void add_seeds();
  void build_air();
  void build_location();
  void start_air();
  void adapt();
  bool adaptive() const { return domain && parameters.refinement.interval > 0; }

  SimulationParameters& parameters;
  MPI_Comm comm;
  Dem seeds;
  std::optional<Domain<3>> domain;
  std::optional<Fluid<3>> air;
  std::optional<PrescribedAir> prescribed;
  PointLocation<3> location;
  std::optional<CoupledStep> two_way;
  std::optional<OneWayStep> one_way;
  long n_steps = 0;
  double adaptation_change = 0;
};

}  // namespace seedflow
