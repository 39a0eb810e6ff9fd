#include "seedflow/diagnose/command.h"

#include <mpi.h>

#include <filesystem>
#include <ostream>
#include <sstream>

#include "least_runs.h"
#include "seedflow/base/error.h"
#include "seedflow/diagnose/diagnosis_files.h"
#include "seedflow/diagnose/problem_file.h"
#include "seedflow/diagnose/run_store.h"

namespace seedflow {

namespace {

/// For --dry-run: what is weighed, and the runs it takes.
int say_what_it_will_be(const Problem& problem, std::ostream& out) {
  RunStore store;
  const ObservableModel model(problem, store);
  const auto listed = [&](const char* what, const auto& all, const auto& text_of) {
    out << what;
    for (std::size_t i = 0; i < all.size(); ++i) out << (i > 0 ? ", " : "") << text_of(all[i]);
    out << '\n';
  };
  listed("Conditions: ", model.conditions(),
         [](const Condition& c) { return c.name + (c.held_out ? " (held out)" : ""); });
  listed("Candidates: ", model.candidates(), [](const Candidate& c) { return c.name; });
  listed("Inputs:     ", model.nuisances(), [](const Nuisance& n) { return n.name; });
  out << "Runs:       at least " << least_runs(model) << ", repeats included; at most " << problem.budget.runs
      << std::endl;
  return exit_done;
}

int run(const CommandLine&, const std::vector<std::string>& arguments, std::ostream& out) {
  const RunOptions options = read_run_options(arguments);
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  if (options.resume)
    throw InputError("--resume: a diagnosis always goes on where it was interrupted. Leave the option out.");
  const Problem problem = read_problem(options.prm, options.overrides);
  if (options.dry_run) {
    std::ostringstream nobody;
    return say_what_it_will_be(problem, rank == 0 ? out : nobody);
  }
  const std::filesystem::path folder = options.output;
  const OtherBuilds others = read_other_builds(options.prm, options.overrides);
  RunStore store(folder, MPI_COMM_WORLD, others);
  if (rank == 0 && store.of_other_builds() > 0) {
    out << store.of_other_builds() << " finished runs in " << folder.string()
        << " were made by another build of the program; they are ";
    if (others == OtherBuilds::use)
      out << "used all the same." << std::endl;
    else
      out << "made again where they are needed. Where the two builds cannot differ in what these runs show:\n"
             "  --set \"Runs of other builds=use\""
          << std::endl;
  }
  Diagnosis answer = diagnose(problem, store);  // every rank draws the same conclusions
  if (others == OtherBuilds::use && store.of_other_builds() > 0)
    answer.remarks.push_back(std::to_string(store.of_other_builds()) +
                             " remembered runs were made by another build of the program.");
  if (rank != 0) return exit_done;
  write_diagnosis(folder / "diagnosis.json", problem, answer);
  write_diagnosed_model(folder / (problem.name + ".diagnosed.prm"), problem, answer);
  write_diagnosis_report(folder / "report.html", problem, answer, "./seedflow diagnose " + options.prm);
  out << verdict_name(answer.verdict) << ": " << answer.sentence << "\n";
  for (const std::string& remark : answer.remarks) out << "  " << remark << "\n";
  out << answer.runs << " runs, " << answer.runs_computed
      << " computed now; report: " << (folder / "report.html").string() << std::endl;
  return exit_done;
}

}  // namespace

Command diagnose_command() {
  return {"diagnose", "diagnose FILE.prm [--set \"Section/Entry=value\"]... [--output DIR] [--dry-run]",
          "find what is missing between a model and measurements", run};
}

}  // namespace seedflow
