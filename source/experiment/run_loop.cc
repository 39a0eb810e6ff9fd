#include "seedflow/experiment/run_loop.h"

#include <cmath>

#include "seedflow/base/binary.h"
#include "seedflow/experiment/recorder.h"
#include "seedflow/experiment/supervised_run.h"

namespace seedflow {

namespace {

/// What changes between checkpoints besides the simulation itself.
struct Tally {
  double largest_mass_error = 0;  ///< relative
};

void save_state(const Simulation& simulation, const Tally& tally, CheckpointWriter& checkpoint) {
  simulation.save(checkpoint.stream("seeds"), checkpoint.stream("air"), checkpoint.stream("coupling"),
                  checkpoint.external("mesh"));
  write_binary(checkpoint.stream("run"), tally);
}

void load_state(Simulation& simulation, Tally& tally, CheckpointReader& checkpoint) {
  simulation.load(checkpoint.stream("seeds"), checkpoint.stream("air"), checkpoint.stream("coupling"),
                  checkpoint.external("mesh"));
  read_binary(checkpoint.stream("run"), tally);
}

/// The number of steps which a run that goes on at `time` has behind it.
long steps_done(double time, double dt, const Parameters& parameters) {
  const double steps = time / dt;
  const long whole = std::lround(steps);
  if (std::abs(steps - whole) > 1e-6)
    parameters.reject("Run/End time",
                      "the checkpoint at " + std::to_string(time) +
                          " s does not lie between two of the equal air steps up to this time",
                      "choose a multiple of the air step");
  return whole;
}

void add_performance(const Simulation& simulation, double wall_time, double air_steps, Summary& summary) {
  const double cores = dealii::Utilities::MPI::n_mpi_processes(simulation.communicator());
  summary.performance.wall_time_s = wall_time;
  summary.performance.peak_memory_MiB = peak_memory_MiB(simulation.communicator());
  summary.performance.sub_sphere_steps_per_second_per_core =
      static_cast<double>(simulation.dem().n_substeps()) * simulation.dem().n_spheres() / wall_time / cores;
  summary.performance.cell_steps_per_second_per_core = air_steps * simulation.n_cells() / wall_time / cores;
}

}  // namespace

void add_conservation(Simulation& simulation, double largest_mass_error, Summary& summary) {
  if (!simulation.coupled()) return;
  // Limits: solver tolerances for the air; round-off, grown by the number of steps, for what is pure
  // bookkeeping.
  const MomentumLedger& ledger = simulation.coupled()->momentum();
  summary.conserve("air mass, every pressure test function, worst step", largest_mass_error, 1e-8);
  summary.conserve("particle volume in the void fraction", simulation.coupled()->largest_volume_error(),
                   1e-12);
  summary.conserve("momentum of the seeds", ledger.seeds_error(), 1e-9);
  if (simulation.settings().refinement.interval > 0)
    summary.conserve("air momentum, largest change by moving it to an adapted mesh",
                     simulation.momentum_change_by_adaptation(), 1e-8);
  if (!simulation.settings().coupling.two_way) return;
  summary.conserve("momentum exchange seeds - air", ledger.exchange_error(), 1e-11);
  summary.conserve("momentum of seeds, air and walls", ledger.total_error(), 1e-8);
}

void run_to_end(Simulation& simulation, const Parameters& parameters, const RunOptions& options,
                Summary& summary) {
  const MPI_Comm comm = simulation.communicator();
  const RunParameters& run = simulation.settings().run;
  const long n_steps = std::max(1L, std::lround(std::ceil(run.end_time / run.air_step - 1e-9)));
  const double dt = run.end_time / n_steps;

  Tally tally;
  SupervisedRun supervised(parameters, options, comm,
                           [&](CheckpointWriter& c) { save_state(simulation, tally, c); });
  std::optional<double> resumed;
  if (options.resume) {
    supervised.resume([&](CheckpointReader& c) { load_state(simulation, tally, c); },
                      {"Run/End time", "Run/Series interval", "Run/Checkpoint interval"});
    resumed = simulation.time();
    if (*resumed > run.end_time * (1 + 1e-9))
      parameters.reject("Run/End time", "the checkpoint is at " + std::to_string(*resumed) + " s already",
                        "choose a later time");
  }
  long step = resumed ? steps_done(*resumed, dt, parameters) : 0;
  Recorder recorder(simulation, options.output, resumed);
  if (!resumed) recorder.record(simulation);

  LongWork work;
  work.end = run.end_time;
  work.checkpoint_interval = run.checkpoint_interval;
  work.time = [&] { return simulation.time(); };
  work.finished = [&] { return step >= n_steps; };
  work.advance = [&] {
    simulation.advance(dt);
    ++step;
    if (Fluid<3>* air = simulation.fluid())
      tally.largest_mass_error =
          std::max({tally.largest_mass_error, air->mass_balance().largest, air->mass_balance().total});
    recorder.record(simulation);
  };
  supervised.carry_out(work);
  if (Fluid<3>* air = simulation.fluid()) {
    // Of the last step; empty for a domain of walls.
    for (const auto& [side, flow] : air->mass_balance().outflow)
      summary.observe("air leaving through side " + side, flow, "m3/s");
    for (const auto& [side, power] : air->mass_balance().power)
      summary.observe("power of the pressure leaving through side " + side, power, "W");
  }
  add_performance(simulation, supervised.wall_time(), static_cast<double>(n_steps), summary);
  add_conservation(simulation, tally.largest_mass_error, summary);
}

}  // namespace seedflow
