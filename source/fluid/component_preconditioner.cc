#include "seedflow/fluid/component_preconditioner.h"

namespace seedflow {

namespace {

class Jacobi : public ComponentPreconditioner {
 public:
  void build(const SparseMatrix& matrix) override {
    inverse.resize(matrix.structure().n_owned());
    for (std::size_t i = 0; i < inverse.size(); ++i) {
      const double a = matrix.diagonal(i);
      inverse[i] = a != 0 ? 1 / a : 1;
    }
  }
  void apply(NodeBlock* z, const NodeBlock* r) override {
    for (std::size_t i = 0; i < inverse.size(); ++i) z[i] = inverse[i] * r[i];
  }

 private:
  std::vector<double> inverse;
};

}  // namespace

std::unique_ptr<ComponentPreconditioner> make_component_preconditioner(const std::string& kind) {
  if (kind == "ilu") return make_incomplete_factors();
  return std::make_unique<Jacobi>();
}

}  // namespace seedflow
