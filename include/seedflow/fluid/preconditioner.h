#pragma once

#include <memory>
#include <string>
#include <vector>

#include "seedflow/fluid/sparse_matrix.h"

namespace seedflow {

/// An approximate inverse by one of the libraries. Nodes marked `fixed` are decoupled: their rows and columns
/// are those of the diagonal.
class Preconditioner {
 public:
  virtual ~Preconditioner() = default;
  /// `singular`: the matrix has the constants as null space; the preconditioner then ties one node down.
  virtual void build(const SparseMatrix& matrix, const std::vector<char>& fixed, bool singular) = 0;
  virtual void apply(NodalVector& z, const NodalVector& r) = 0;
};

/// Algebraic multigrid by `backend`: "trilinos" (ML's smoothed aggregation) or "petsc" (BoomerAMG of hypre).
std::unique_ptr<Preconditioner> make_multigrid(const std::string& backend);

std::unique_ptr<Preconditioner> make_trilinos_multigrid();
std::unique_ptr<Preconditioner> make_petsc_multigrid();

}  // namespace seedflow
