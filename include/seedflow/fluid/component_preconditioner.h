#pragma once

#include <memory>
#include <string>

#include "seedflow/fluid/sparse_matrix.h"

namespace seedflow {

/// The components of a node side by side (the fourth is padding): one pass over a matrix serves them all.
typedef double NodeBlock __attribute__((vector_size(4 * sizeof(double))));

/// An approximate inverse of a matrix that all components of a vector share. Each rank treats its owned
/// nodes alone.
class ComponentPreconditioner {
 public:
  virtual ~ComponentPreconditioner() = default;
  /// All matrices given to one preconditioner have the same SparsityStructure; their patches may differ.
  virtual void build(const SparseMatrix& matrix) = 0;
  /// z = A^-1 r approximately, per owned node; z is not r.
  virtual void apply(NodeBlock* z, const NodeBlock* r) = 0;
};

/// `kind`:
///   jacobi  the diagonal
///   ilu     incomplete factors without fill, ILU(0), in reverse Cuthill-McKee order (1969,
///           doi:10.1145/800195.805928) of the structure without patch. In that order most neighbours of a
///           node come in fronts, and far fewer dropped entries disturb the convection than in the order of
///           the mesh (Benzi 2002, doi:10.1006/jcph.2002.7176, section 3.3). The factors are kept in single
///           precision, which the solver around them does not notice.
std::unique_ptr<ComponentPreconditioner> make_component_preconditioner(const std::string& kind);

std::unique_ptr<ComponentPreconditioner> make_incomplete_factors();

}  // namespace seedflow
