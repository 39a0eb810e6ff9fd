#pragma once

#include <string>
#include <vector>

#include "seedflow/fluid/component_preconditioner.h"
#include "seedflow/fluid/preconditioner.h"
#include "seedflow/fluid/sparse_matrix.h"

namespace seedflow {

/// Krylov methods on nodal vectors. Values of `fixed` nodes in x are kept (given and constrained nodes), so
/// the operator acts on the free nodes alone and one matrix serves components with different given nodes.

/// Preconditioned conjugate gradients for A x = b until |residual|_2 <= tolerance. `singular`: constants are
/// removed from residuals and corrections. Returns the number of iterations; -1 if not reached.
int conjugate_gradients(const SparseMatrix& matrix, Preconditioner& preconditioner,
                        const std::vector<char>& fixed, bool singular, NodalVector& x, const NodalVector& b,
                        double tolerance, int max_iterations);

/// BiCGStab (van der Vorst 1992, doi:10.1137/0913035) for n systems with one matrix at once, until the
/// residual divided by the diagonal of A is at most relative_tolerance times the largest |x| of all
/// components in every node. Returns the number of iterations; -1 if not reached.
int stabilized_biconjugate_gradients(const SparseMatrix& matrix, ComponentPreconditioner& preconditioner,
                                     int n, const std::vector<char>* const* fixed, NodalVector* const* x,
                                     const NodalVector* const* b, double relative_tolerance,
                                     int max_iterations);

}  // namespace seedflow
