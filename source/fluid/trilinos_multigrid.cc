#include <Epetra_CrsMatrix.h>
#include <Epetra_Map.h>
#include <Epetra_MpiComm.h>
#include <Epetra_Vector.h>
#include <ml_MultiLevelPreconditioner.h>
#include <Teuchos_ParameterList.hpp>

#include "seedflow/base/error.h"
#include "seedflow/fluid/preconditioner.h"

namespace seedflow {

namespace {

class Trilinos : public Preconditioner {
 public:
  void build(const SparseMatrix& m, const std::vector<char>& fixed, bool singular) override {
    const SparsityStructure& s = m.structure();
    const int n = s.n_owned(), n_local = n + s.partitioner->n_ghost_indices();
    const bool patched = m.patch() != nullptr;
    const SparseMatrix::Rows rows_of = patched ? m.merged() : SparseMatrix::Rows();
    const std::uint32_t* from = patched ? rows_of.start.data() : s.row_start.data();
    const std::uint32_t* columns_of = patched ? rows_of.column.data() : s.column.data();
    const double* values_of = patched ? rows_of.value.data() : m.value.data();
    if (!matrix || patched) {
      multigrid.reset();
      std::vector<int> ids(n_local);
      for (int i = 0; i < n_local; ++i) ids[i] = s.partitioner->local_to_global(i);
      communicator = std::make_unique<Epetra_MpiComm>(s.partitioner->get_mpi_communicator());
      rows = std::make_unique<Epetra_Map>(-1, n, ids.data(), 0, *communicator);
      columns = std::make_unique<Epetra_Map>(-1, n_local, ids.data(), 0, *communicator);
      std::vector<int> length(n);
      for (int i = 0; i < n; ++i) length[i] = from[i + 1] - from[i];
      matrix = std::make_unique<Epetra_CrsMatrix>(Copy, *rows, *columns, length.data(), true);
      std::vector<int> local(columns_of, columns_of + from[n]);
      for (int i = 0; i < n; ++i)
        matrix->InsertMyValues(i, length[i], values_of + from[i], local.data() + from[i]);
      matrix->FillComplete(*rows, *rows);
      matrix->OptimizeStorage();
    }
    int *start = nullptr, *column = nullptr;
    double* value = nullptr;
    matrix->ExtractCrsDataPointers(start, column, value);
    for (int i = 0; i < n; ++i)
      for (int k = start[i]; k < start[i + 1]; ++k) {
        const double a = values_of[k];
        if (column[k] == i)
          value[k] = a != 0 ? a : 1.0;
        else
          value[k] = fixed[i] || fixed[column[k]] ? 0.0 : a;
      }
    if (singular && rows->MyGID(0))
      for (int k = start[0]; k < start[1]; ++k)
        if (column[k] == 0) value[k] *= 1.5;
    Teuchos::ParameterList list;
    ML_Epetra::SetDefaults("SA", list);
    list.set("ML output", 0);
    list.set("aggregation: type", "Uncoupled");
    list.set("aggregation: threshold", 1e-4);
    list.set("smoother: type", "symmetric Gauss-Seidel");
    list.set("smoother: sweeps", 1);
    list.set("coarse: type", "Amesos-KLU");
    list.set("coarse: max size", 500);
    list.set("eigen-analysis: type", "Anorm");
    multigrid.reset();
    multigrid = std::make_unique<ML_Epetra::MultiLevelPreconditioner>(*matrix, list, true);
    if (!multigrid->IsPreconditionerComputed())
      throw RunError(
          "Air: ML could not build the multigrid preconditioner of the pressure. Try backend petsc.");
  }

  void apply(NodalVector& z, const NodalVector& r) override {
    Epetra_Vector in(View, *rows, const_cast<double*>(r.begin())), out(View, *rows, z.begin());
    multigrid->ApplyInverse(in, out);
  }

 private:
  std::unique_ptr<Epetra_MpiComm> communicator;
  std::unique_ptr<Epetra_Map> rows, columns;
  std::unique_ptr<Epetra_CrsMatrix> matrix;
  std::unique_ptr<ML_Epetra::MultiLevelPreconditioner> multigrid;
};

}  // namespace

std::unique_ptr<Preconditioner> make_trilinos_multigrid() {
  return std::make_unique<Trilinos>();
}

}  // namespace seedflow
