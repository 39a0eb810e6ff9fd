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
  /// `pattern`: rows of the locally relevant unknowns as this rank's cells couple them. Collective.
  SparsityStructure(dealii::DynamicSparsityPattern& pattern, const dealii::IndexSet& owned,
                    const dealii::IndexSet& relevant, MPI_Comm comm);

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

/// The values. Cells add to `value` directly, then compress() sends the rows of others home.
class SparseMatrix {
 public:
  explicit SparseMatrix(std::shared_ptr<const SparsityStructure> structure);

  const SparsityStructure& structure() const { return *shape; }
  std::vector<double> value;

  void set_zero();
  void compress();
  /// y_d = A x_d for n vectors at once, owned rows; the ghosts of x must be current.
  void multiply(int n, NodalVector* const* y, const NodalVector* const* x) const;
  /// (A x)_row
  double row_times(std::uint32_t row, const NodalVector& x) const;

 private:
  std::shared_ptr<const SparsityStructure> shape;
  std::vector<double> buffer;
};

}  // namespace seedflow
