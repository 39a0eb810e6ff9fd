#include "seedflow/experiment/run_loop.h"

#include <chrono>
#include <cmath>
#include <sstream>

#include "seedflow/base/interrupt.h"
#include "seedflow/base/together.h"
#include "seedflow/experiment/agreement.h"
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
  simulation.save(checkpoint.stream("seeds"), checkpoint.stream("air"), checkpoint.stream("coupling"),
                  checkpoint.external("mesh"));
  std::ostream& run = checkpoint.stream("run");
  run.write(reinterpret_cast<const char*>(&tally), sizeof tally);
  checkpoint.commit();
}

Tally load_state(Simulation& simulation, const Parameters& parameters, const std::filesystem::path& folder) {
  CheckpointReader checkpoint(folder, simulation.communicator());
  checkpoint.require_same_parameters(as_text(parameters),
                                     {"Run/End time", "Run/Series interval", "Run/Checkpoint interval"});
  simulation.load(checkpoint.stream("seeds"), checkpoint.stream("air"), checkpoint.stream("coupling"),
                  checkpoint.external("mesh"));
  Tally tally;
  checkpoint.stream("run").read(reinterpret_cast<char*>(&tally), sizeof tally);
  return tally;
}

/// A run that is not resumed begins with no state of an earlier one, which a later --resume would take for
/// its own.
void remove_old_states(const std::filesystem::path& folder, MPI_Comm comm) {
  together(comm, [&] {
    if (dealii::Utilities::MPI::this_mpi_process(comm) != 0) return;
    for (const char* name : {"checkpoint", "failed"}) std::filesystem::remove_all(folder / name);
  });
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

/// Where the ranks find each other when one of them may have failed alone and the others wait elsewhere.
class Meeting {
 public:
  explicit Meeting(MPI_Comm comm) { MPI_Comm_dup(comm, &own); }
  ~Meeting() {
    if (complete) MPI_Comm_free(&own);  // waits for all
  }
  Meeting(const Meeting&) = delete;
  Meeting& operator=(const Meeting&) = delete;
  bool all_arrive() { return complete = all_ranks_arrive(own, 10.0 /* s */); }

 private:
  MPI_Comm own;
  bool complete = true;
};

/// Saves the state at a failure, to look at; apart from the checkpoints, which are sound. Returns what to
/// tell the user; nothing that goes wrong here may hide the failure itself.
std::string save_failed_state(const Simulation& simulation, const Tally& tally, const Parameters& parameters,
                              const std::filesystem::path& folder, Meeting& meeting) {
  if (!meeting.all_arrive()) return "";
  try {
    save_state(simulation, tally, parameters, folder);
    return "\nThe state at the failure is saved in '" + folder.string() + "'.";
  } catch (const std::exception& error) {
    return std::string("\nThe state at the failure could not be saved: ") + error.what();
  }
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
  if (simulation.settings().refinement.interval > 0)
    summary.conserve("air momentum, largest change by moving it to an adapted mesh",
                     simulation.momentum_change_by_adaptation());
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

  Meeting meeting(comm);
  InterruptGuard signals(comm);
  Tally tally;
  std::optional<double> resumed;
  if (options.resume) {
    tally = load_state(simulation, parameters, folder / "checkpoint");
    resumed = simulation.time();
    if (*resumed > run.end_time * (1 + 1e-9))
      parameters.reject("Run/End time", "the checkpoint is at " + std::to_string(*resumed) + " s already",
                        "choose a later time");
  } else {
    remove_old_states(folder, comm);
  }
  const long first_step = resumed ? steps_done(*resumed, dt, parameters) : 0;
  together(comm, [&] {
    if (rank == 0) write_file_atomically(folder / "used.prm", as_text(parameters));
  });
  Recorder recorder(simulation, folder, resumed);
  if (!resumed) recorder.record(simulation);

  Progress progress("simulated", run.end_time, simulation.time(), rank);
  const Clock::time_point begin = Clock::now();
  Clock::time_point last_checkpoint = begin;
  const double time_before = tally.wall_time;
  try {
    signals.check();
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
  } catch (const RunError& error) {
    throw RunError(error.what() +
                   save_failed_state(simulation, tally, parameters, folder / "failed", meeting));
  } catch (const std::exception&) {
    save_failed_state(simulation, tally, parameters, folder / "failed", meeting);
    throw;
  }
  progress.finish();
  // A finished run can be continued to a later end.
  save_state(simulation, tally, parameters, folder / "checkpoint");
  add_performance(simulation, tally, static_cast<double>(n_steps), summary);
  add_conservation(simulation, tally.largest_mass_error, summary);
}

}  // namespace seedflow
