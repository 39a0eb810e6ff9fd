#include "seedflow/fluid/preconditioner.h"

namespace seedflow {

std::unique_ptr<Preconditioner> make_multigrid(const std::string& backend) {
  return backend == "petsc" ? make_petsc_multigrid() : make_trilinos_multigrid();
}

}  // namespace seedflow
