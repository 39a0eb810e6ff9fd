#include <deal.II/base/mpi.h>

#include <iostream>

#include "seedflow/diagnose/benchmark_command.h"
#include "seedflow/diagnose/command.h"
#include "seedflow/experiment/agreement.h"
#include "seedflow/experiment/command_line.h"

// Present when the linear algebra is OpenBLAS. Its waiting threads spin, which takes a core from the other
// ranks and counts as computing time.
extern "C" void openblas_set_num_threads(int) __attribute__((weak));

int main(int argc, char** argv) {
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  if (openblas_set_num_threads) openblas_set_num_threads(1);
  // The libraries started here (PETSc among them) read options of their own; they get none of ours.
  int no_arguments = 1;
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(no_arguments, argv, 1);

  seedflow::CommandLine command_line;
  command_line.commands = {seedflow::diagnose_command(), seedflow::diagnosis_benchmark_command()};
  command_line.rank = static_cast<int>(dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD));
  return seedflow::run_in_agreement(
      MPI_COMM_WORLD, [&] { return command_line.execute(arguments, std::cout); }, std::cerr);
}
