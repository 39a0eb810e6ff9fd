#include "seedflow/experiment/run_loop.h"

#include <chrono>
#include <cmath>
#include <sstream>

#include "seedflow/base/interrupt.h"
#include "seedflow/experiment/recorder.h"
#include "seedflow/output/checkpoint.h"
#include "seedflow/output/folder.h"
#include "seedflow/output/progress.h"

namespace seedflow {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

std::string as_text(const Parameters& parameters) {
  std::ostringstream text;
  parameters.write(text);
  return text.str();
}

/// What changes between checkpoints besides the simulation itself.
struct Tally {
  double wall_time = 0;           ///< [s], over all resumed parts
  double largest_mass_error = 0;  ///< relative
  double mass_flow = 0;
};

void save_state(const Simulation& simulation, const Tally& tally, const Parameters& parameters,
                const std::filesystem::path& folder) {
  CheckpointWriter checkpoint(folder, simulation.time(), as_text(parameters), simulation.communicator());
  simulation.save(checkpoint.stream("seeds"), checkpoint.stream("air"), checkpoint.stream("coupling"));
  std::ostream& run = checkpoint.stream("run");
  run.write(reinterpret_cast<const char*>(&tally), sizeof tally);
  checkpoint.commit();
}

Tally load_state(Simulation& simulation, const Parameters& parameters, const std::filesystem::path& folder) {
  CheckpointReader checkpoint(folder, simulation.communicator());
  checkpoint.require_same_parameters(as_text(parameters), {"Run/"});
  simulation.load(checkpoint.stream("seeds"), checkpoint.stream("air"), checkpoint.stream("coupling"));
  Tally tally;
  checkpoint.stream("run").read(reinterpret_cast<char*>(&tally), sizeof tally);
  return tally;
}

void add_performance(const Simulation& simulation, const Tally& tally, double air_steps, Summary& summary) {
  const double cores = dealii::Utilities::MPI::n_mpi_processes(simulation.communicator());
  summary.performance.wall_time_s = tally.wall_time;
  summary.performance.peak_memory_MiB = peak_memory_MiB(simulation.communicator());
  summary.performance.sub_sphere_steps_per_second_per_core =
      static_cast<double>(simulation.dem().n_substeps()) * simulation.dem().n_spheres() / tally.wall_time /
      cores;
  summary.performance.cell_steps_per_second_per_core =
      air_steps * simulation.n_cells() / tally.wall_time / cores;
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
  if (!simulation.settings().coupling.two_way) return;
  summary.conserve("momentum exchange seeds - air", ledger.exchange_error(), 1e-11);
  summary.conserve("momentum of seeds, air and walls", ledger.total_error(), 1e-8);
}

void run_to_end(Simulation& simulation, const Parameters& parameters, const RunOptions& options,
                Summary& summary) {
  const std::filesystem::path folder = options.output;
  const MPI_Comm comm = simulation.communicator();
  const int rank = dealii::Utilities::MPI::this_mpi_process(comm);
  const RunParameters& run = simulation.settings().run;
  const long n_steps = std::max(1L, std::lround(std::ceil(run.end_time / run.air_step - 1e-9)));
  const double dt = run.end_time / n_steps;

  Tally tally;
  std::optional<double> resumed;
  if (options.resume) {
    tally = load_state(simulation, parameters, folder / "checkpoint");
    resumed = simulation.time();
  }
  if (rank == 0) write_file_atomically(folder / "used.prm", as_text(parameters));
  Recorder recorder(simulation, folder, resumed);
  if (!resumed) recorder.record(simulation);

  InterruptGuard signals(comm);
  Progress progress("simulated", run.end_time, simulation.time(), rank);
  Clock::time_point begin = Clock::now(), last_checkpoint = begin;
  const double time_before = tally.wall_time;
  const long first_step = std::lround(simulation.time() / dt);
  try {
    for (long step = first_step; step < n_steps; ++step) {
      simulation.advance(dt);
      if (Fluid<3>* air = simulation.fluid())
        tally.largest_mass_error =
            std::max({tally.largest_mass_error, air->mass_balance().largest, air->mass_balance().total});
      recorder.record(simulation);
      tally.wall_time = time_before + seconds_since(begin);
      progress.update(simulation.time());
      signals.check();
      if (dealii::Utilities::MPI::max(seconds_since(last_checkpoint), comm) > run.checkpoint_interval) {
        save_state(simulation, tally, parameters, folder / "checkpoint");
        last_checkpoint = Clock::now();
      }
    }
  } catch (const Interrupted&) {
    save_state(simulation, tally, parameters, folder / "checkpoint");
    if (rank == 0)
      std::fprintf(
          stderr,
          "\nInterrupted at t = %g s. The checkpoint is written; continue with --resume --output %s\n",
          simulation.time(), folder.c_str());
    throw;
  } catch (const RunError&) {
    // The state at the failure, to look at; apart from the checkpoints, which are sound.
    save_state(simulation, tally, parameters, folder / "failed");
    throw;
  }
  progress.finish();
  add_performance(simulation, tally, static_cast<double>(n_steps), summary);
  add_conservation(simulation, tally.largest_mass_error, summary);
}

}  // namespace seedflow
