#pragma once

#include <memory>
#include <string>
#include <vector>

#include "seedflow/fluid/sparse_matrix.h"

namespace seedflow {

/// An approximate inverse by one of the libraries (or the diagonal). Nodes marked `fixed` are decoupled:
/// their rows and columns are those of the diagonal.
class Preconditioner {
 public:
  virtual ~Preconditioner() = default;
  /// `singular`: the matrix has the constants as null space; the preconditioner then ties one node down.
  virtual void build(const SparseMatrix& matrix, const std::vector<char>& fixed, bool singular) = 0;
  virtual void apply(NodalVector& z, const NodalVector& r) = 0;
  /// The inverse diagonal, which solvers apply by themselves.
  virtual bool is_diagonal() const { return false; }
};

enum class PreconditionerKind { jacobi, ilu, multigrid };

/// `backend`: "trilinos" (Ifpack ILU(0); ML smoothed aggregation) or "petsc" (block Jacobi with ILU(0);
/// BoomerAMG).
std::unique_ptr<Preconditioner> make_preconditioner(const std::string& backend, PreconditionerKind kind);

std::unique_ptr<Preconditioner> make_trilinos_preconditioner(PreconditionerKind kind);
std::unique_ptr<Preconditioner> make_petsc_preconditioner(PreconditionerKind kind);

}  // namespace seedflow
