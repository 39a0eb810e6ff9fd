#include "seedflow/fluid/preconditioner.h"

namespace seedflow {

namespace {

class Jacobi : public Preconditioner {
 public:
  void build(const SparseMatrix& matrix, const std::vector<char>&, bool) override {
    inverse.resize(matrix.structure().n_owned());
    for (std::size_t i = 0; i < inverse.size(); ++i) {
      const double a = matrix.diagonal(i);
      inverse[i] = a != 0 ? 1 / a : 1;
    }
  }
  void apply(NodalVector& z, const NodalVector& r) override {
    double* out = z.begin();
    const double* in = r.begin();
    for (std::size_t i = 0; i < inverse.size(); ++i) out[i] = inverse[i] * in[i];
  }
  bool is_diagonal() const override { return true; }

 private:
  std::vector<double> inverse;
};

}  // namespace

std::unique_ptr<Preconditioner> make_preconditioner(const std::string& backend, PreconditionerKind kind) {
  if (kind == PreconditionerKind::jacobi) return std::make_unique<Jacobi>();
  return backend == "petsc" ? make_petsc_preconditioner(kind) : make_trilinos_preconditioner(kind);
}

}  // namespace seedflow
