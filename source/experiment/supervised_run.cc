#include "seedflow/experiment/supervised_run.h"

#include <chrono>
#include <cstdio>
#include <sstream>

#include "seedflow/base/binary.h"
#include "seedflow/base/interrupt.h"
#include "seedflow/base/together.h"
#include "seedflow/experiment/agreement.h"
#include "seedflow/output/folder.h"
#include "seedflow/output/progress.h"

namespace seedflow {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

double largest_of_all(double value, MPI_Comm comm) {
  double largest = 0;
  MPI_Allreduce(&value, &largest, 1, MPI_DOUBLE, MPI_MAX, comm);
  return largest;
}

}  // namespace

std::string as_text(const Parameters& parameters) {
  std::ostringstream text;
  parameters.write(text);
  return text.str();
}

SupervisedRun::SupervisedRun(const Parameters& p, const RunOptions& run_options, MPI_Comm communicator,
                             Save save_function)
    : parameters(p),
      options(run_options),
      comm(communicator),
      save(std::move(save_function)),
      meeting(communicator) {
  MPI_Comm_rank(comm, &rank);
  if (options.resume) return;
  together(comm, [&] {
    if (rank != 0) return;
    for (const char* name : {"checkpoint", "failed"})
      std::filesystem::remove_all(std::filesystem::path(options.output) / name);
  });
}

SupervisedRun::~SupervisedRun() = default;

void SupervisedRun::save_state(const std::string& folder, double time) const {
  CheckpointWriter checkpoint(std::filesystem::path(options.output) / folder, time, as_text(parameters),
                              comm);
  save(checkpoint);
  write_binary(checkpoint.stream("supervision"), seconds);
  checkpoint.commit();
}

/// Returns what to tell the user; nothing that goes wrong here may hide the failure itself.
std::string SupervisedRun::save_failed_state(double time) {
  if (!meeting.all_arrive(10.0 /* s */)) return "";
  try {
    save_state("failed", time);
    return "\nThe state at the failure is saved in '" +
           (std::filesystem::path(options.output) / "failed").string() + "'.";
  } catch (const std::exception& error) {
    return std::string("\nThe state at the failure could not be saved: ") + error.what();
  }
}

void SupervisedRun::resume(const Load& load, const std::vector<std::string>& may_change) {
  CheckpointReader checkpoint(std::filesystem::path(options.output) / "checkpoint", comm);
  checkpoint.require_same_parameters(as_text(parameters), may_change);
  checkpoint.read([&] {
    load(checkpoint);
    read_binary(checkpoint.stream("supervision"), seconds);
  });
}

void SupervisedRun::carry_out(const LongWork& work) {
  const InterruptGuard signals(comm);
  together(comm, [&] {
    if (rank == 0)
      write_file_atomically(std::filesystem::path(options.output) / "used.prm", as_text(parameters));
  });
  Progress progress(work.label, work.end, work.time(), rank);
  const Clock::time_point begin = Clock::now();
  Clock::time_point last_checkpoint = begin;
  const double before = seconds;
  try {
    signals.check();
    while (!work.finished()) {
      work.advance();
      seconds = before + seconds_since(begin);
      progress.update(work.time(), work.note ? work.note() : "");
      signals.check();
      if (largest_of_all(seconds_since(last_checkpoint), comm) > work.checkpoint_interval) {
        save_state("checkpoint", work.time());
        last_checkpoint = Clock::now();
      }
    }
  } catch (const Interrupted&) {
    save_state("checkpoint", work.time());
    if (rank == 0)
      std::fprintf(
          stderr,
          "\nInterrupted at t = %g s. The checkpoint is written; continue with --resume --output %s\n",
          work.time(), options.output.c_str());
    throw;
  } catch (const RunError& error) {
    throw RunError(error.what() + save_failed_state(work.time()));
  } catch (const std::exception&) {
    save_failed_state(work.time());
    throw;
  }
  progress.finish();
  // A finished run can be continued to a later end.
  save_state("checkpoint", work.time());
}

}  // namespace seedflow
