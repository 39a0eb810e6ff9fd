#include <petscpc.h>

#include "seedflow/base/error.h"
#include "seedflow/fluid/preconditioner.h"

namespace seedflow {

namespace {

void check(PetscErrorCode code, const char* what) {
  if (code != 0) throw RunError(std::string("Air: PETSc failed in ") + what + ". Try backend trilinos.");
}

class Petsc : public Preconditioner {
 public:
  ~Petsc() override { destroy(); }

  void build(const SparseMatrix& m, const std::vector<char>& fixed, bool singular) override {
    destroy();
    const SparsityStructure& s = m.structure();
    const auto& partitioner = *s.partitioner;
    const PetscInt n = s.n_owned();
    const MPI_Comm comm = partitioner.get_mpi_communicator();
    const bool patched = m.patch() != nullptr;
    const SparseMatrix::Rows rows = patched ? m.merged() : SparseMatrix::Rows();
    const std::uint32_t* from = patched ? rows.start.data() : s.row_start.data();
    const std::uint32_t* columns = patched ? rows.column.data() : s.column.data();
    const double* values = patched ? rows.value.data() : m.value.data();
    std::vector<PetscInt> start(from, from + n + 1), column(start.back());
    std::vector<PetscScalar> value(start.back());
    for (PetscInt i = 0; i < n; ++i)
      for (PetscInt k = start[i]; k < start[i + 1]; ++k) {
        const PetscInt local = columns[k];
        column[k] = partitioner.local_to_global(local);
        const double a = values[k];
        if (local == i)
          value[k] = a != 0 ? a : 1.0;
        else
          value[k] = fixed[i] || fixed[local] ? 0.0 : a;
      }
    if (singular && partitioner.in_local_range(0))
      for (PetscInt k = start[0]; k < start[1]; ++k)
        if (column[k] == 0) value[k] *= 1.5;
    check(MatCreateMPIAIJWithArrays(comm, n, n, PETSC_DETERMINE, PETSC_DETERMINE, start.data(), column.data(),
                                    value.data(), &matrix),
          "MatCreateMPIAIJWithArrays");
    check(PCCreate(comm, &preconditioner), "PCCreate");
    check(PCSetOperators(preconditioner, matrix, matrix), "PCSetOperators");
    check(PCSetType(preconditioner, PCHYPRE), "PCSetType");
    check(PCHYPRESetType(preconditioner, "boomeramg"), "PCHYPRESetType");
    check(PetscOptionsSetValue(nullptr, "-seedflow_pc_hypre_boomeramg_strong_threshold", "0.5"), "options");
    check(PetscOptionsSetValue(nullptr, "-seedflow_pc_hypre_boomeramg_coarsen_type", "HMIS"), "options");
    check(PetscOptionsSetValue(nullptr, "-seedflow_pc_hypre_boomeramg_interp_type", "ext+i"), "options");
    check(PetscOptionsSetValue(nullptr, "-seedflow_pc_hypre_boomeramg_agg_nl", "1"), "options");
    check(PCSetOptionsPrefix(preconditioner, "seedflow_"), "PCSetOptionsPrefix");
    check(PCSetFromOptions(preconditioner), "PCSetFromOptions");
    check(PCSetUp(preconditioner), "PCSetUp");
    check(VecCreateMPIWithArray(comm, 1, n, PETSC_DETERMINE, nullptr, &in), "VecCreate");
    check(VecCreateMPIWithArray(comm, 1, n, PETSC_DETERMINE, nullptr, &out), "VecCreate");
  }

  void apply(NodalVector& z, const NodalVector& r) override {
    VecPlaceArray(in, r.begin());
    VecPlaceArray(out, z.begin());
    const auto code = PCApply(preconditioner, in, out);
    VecResetArray(in);
    VecResetArray(out);
    check(code, "PCApply");
  }

 private:
  void destroy() {
    if (preconditioner) PCDestroy(&preconditioner);
    if (matrix) MatDestroy(&matrix);
    if (in) VecDestroy(&in);
    if (out) VecDestroy(&out);
  }
  Mat matrix = nullptr;
  PC preconditioner = nullptr;
  Vec in = nullptr, out = nullptr;
};

}  // namespace

std::unique_ptr<Preconditioner> make_petsc_multigrid() {
  return std::make_unique<Petsc>();
}

}  // namespace seedflow
