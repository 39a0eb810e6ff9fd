#include "seedflow/diagnose/command.h"

#include <mpi.h>

#include <filesystem>
#include <ostream>

#include "seedflow/base/error.h"
#include "seedflow/diagnose/diagnosis_files.h"
#include "seedflow/diagnose/problem_file.h"
#include "seedflow/diagnose/run_store.h"

namespace seedflow {

namespace {

int run(const CommandLine&, const std::vector<std::string>& arguments, std::ostream& out) {
  const RunOptions options = read_run_options(arguments);
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  const Problem problem = read_problem(options.prm, options.overrides);
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
  return {"diagnose", "diagnose FILE.prm [--set \"Section/Entry=value\"]... [--output DIR]",
          "find what is missing between a model and measurements", run};
}

}  // namespace seedflow
