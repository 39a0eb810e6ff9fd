#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>

#include "seedflow/fluid/component_preconditioner.h"

namespace seedflow {
namespace {

/// A chain of nodes with convection along it, the nodes numbered at random.
SparseMatrix chain(int n) {
  std::vector<int> number(n);
  std::iota(number.begin(), number.end(), 0);
  std::shuffle(number.begin(), number.end(), std::mt19937(5));
  dealii::DynamicSparsityPattern pattern(n, n);
  for (int i = 0; i < n; ++i) pattern.add(i, i);
  for (int i = 0; i < n - 1; ++i) {
    pattern.add(number[i], number[i + 1]);
    pattern.add(number[i + 1], number[i]);
  }
  const dealii::IndexSet all = dealii::complete_index_set(n);
  SparseMatrix matrix(std::make_shared<SparsityStructure>(pattern, all, all, MPI_COMM_SELF));
  const auto& s = matrix.structure();
  for (int i = 0; i < n; ++i) matrix.value[s.diagonal[i]] = 1.2;
  for (int i = 0; i < n - 1; ++i) {
    const int a = number[i], b = number[i + 1];
    matrix.value[s.position(b, a)] = -0.9;  // from upstream
    matrix.value[s.position(a, b)] = -0.2;
  }
  return matrix;
}

/// Largest |A z - r| over the largest |r|.
double residual(const SparseMatrix& matrix, ComponentPreconditioner& preconditioner) {
  const auto& s = matrix.structure();
  const int n = s.n_owned();
  std::vector<NodeBlock> r(n), z(n);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> number(-1, 1);
  for (auto& b : r) b = NodeBlock{number(random), number(random), number(random), 0};
  preconditioner.build(matrix);
  preconditioner.apply(z.data(), r.data());
  double largest = 0;
  for (int i = 0; i < n; ++i) {
    NodeBlock left = -r[i];
    for (std::uint32_t k = s.row_start[i]; k < s.row_start[i + 1]; ++k)
      left += matrix.value[k] * z[s.column[k]];
    for (int c = 0; c < 4; ++c) largest = std::max(largest, std::abs(left[c]));
  }
  return largest;
}

/// Along a chain nothing fills in if it is eliminated from its ends, so the factors are then exact up to
/// single precision; in the given random order they are not by far.
TEST(IncompleteFactors, ExactAlongAChain) {
  const auto ilu = make_component_preconditioner("ilu");
  EXPECT_LT(residual(chain(200), *ilu), 1e-5);
  const auto jacobi = make_component_preconditioner("jacobi");
  EXPECT_GT(residual(chain(200), *jacobi), 0.5);
}

/// A node without an equation, and a pivot that vanishes, leave nothing that is not finite.
TEST(IncompleteFactors, BearsZeroPivots) {
  SparseMatrix matrix = chain(4);
  for (double& a : matrix.value)
    if (a < 0) a = 1.2;  // 2x2 blocks of equal entries: singular
  const auto ilu = make_component_preconditioner("ilu");
  EXPECT_TRUE(std::isfinite(residual(matrix, *ilu)));
  matrix.value[matrix.structure().diagonal[2]] = 0;
  EXPECT_TRUE(std::isfinite(residual(matrix, *ilu)));
}

}  // namespace
}  // namespace seedflow
