#pragma once

#include <deal.II/base/partitioner.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/la_parallel_vector.h>

#include <cstdint>
#include <memory>
#include <vector>

namespace seedflow {

/// One scalar unknown per node: owned values, then ghosts.
using NodalVector = dealii::LinearAlgebra::distributed::Vector<double>;

/// Where the entries of a distributed matrix are: compressed rows in local numbering (owned rows and columns
/// first, then ghosts in the order of the partitioner). Rows of ghosts collect what this rank's cells add to
/// rows of others.
class SparsityStructure {
 public:
  /// `pattern`: rows of the locally relevant unknowns as this rank's cells couple them; `also`: further
  /// unknowns to keep as ghosts. Collective.
  SparsityStructure(dealii::DynamicSparsityPattern& pattern, const dealii::IndexSet& owned,
                    const dealii::IndexSet& relevant, MPI_Comm comm,
                    const dealii::IndexSet& also = dealii::IndexSet());

  /// Position of an entry in the value array; local numbers. The entry must exist.
  std::uint32_t position(std::uint32_t row, std::uint32_t column) const;
  std::uint32_t n_owned() const { return partitioner->locally_owned_size(); }

  std::shared_ptr<const dealii::Utilities::MPI::Partitioner> partitioner;
  std::vector<std::uint32_t> row_start;  ///< owned rows, then ghost rows
  std::vector<std::uint32_t> column;     ///< ascending within a row
  std::vector<std::uint32_t> diagonal;   ///< position of the diagonal entry of each owned row

 private:
  friend class SparseMatrix;
  struct Message {
    int rank;
    std::uint32_t begin, end;             ///< sent: range of the value array
    std::vector<std::uint32_t> position;  ///< received: where each value is added
  };
  std::vector<Message> sent, received;
};

/// Where a matrix has further entries in some of its owned rows: couplings that change from step to step
/// while those of the mesh stay. A place may also occur in the SparsityStructure; the entries then add up.
struct PatchStructure {
  std::vector<std::uint32_t> row;       ///< owned rows, local numbers
  std::vector<std::uint32_t> start{0};  ///< of each of them in `column`
  std::vector<std::uint32_t> column;    ///< local numbers, in no order
  std::vector<std::uint32_t> diagonal;  ///< position of the diagonal entry of each of them
  std::vector<std::int32_t> index;      ///< [owned row]: place in `row`, -1 if it has no further entries
};

/// The values. Cells add to `value` directly, then compress() sends the rows of others home.
class SparseMatrix {
 public:
  explicit SparseMatrix(std::shared_ptr<const SparsityStructure> structure);

  const SparsityStructure& structure() const { return *shape; }
  std::vector<double> value;

  /// Gives the matrix these further entries, zero at first; null: none.
  void set_patch(std::shared_ptr<const PatchStructure> places);
  const std::shared_ptr<const PatchStructure>& patch() const { return more; }
  std::vector<double> patch_value;  ///< complete on the owning rank; compress() has nothing to do with them
  double diagonal(std::uint32_t row) const;
  /// The owned rows with both kinds of entries, each column once.
  struct Rows {
    std::vector<std::uint32_t> start, column;
    std::vector<double> value;
  };
  Rows merged() const;

  void set_zero();
  void compress();
  /// y_d = A x_d for n vectors at once, owned rows; the ghosts of x must be current.
  void multiply(int n, NodalVector* const* y, const NodalVector* const* x) const;
  /// (A x)_row
  double row_times(std::uint32_t row, const NodalVector& x) const;

 private:
  std::shared_ptr<const SparsityStructure> shape;
  std::shared_ptr<const PatchStructure> more;
  std::vector<double> buffer;
};

}  // namespace seedflow
