#include "seedflow/fluid/sparse_matrix.h"

#include <deal.II/base/mpi.h>
#include <deal.II/lac/sparsity_tools.h>

#include <algorithm>
#include <map>

#include "row_sum.h"

namespace seedflow {

using dealii::types::global_dof_index;

SparsityStructure::SparsityStructure(dealii::DynamicSparsityPattern& pattern, const dealii::IndexSet& owned,
                                     const dealii::IndexSet& relevant, MPI_Comm comm,
                                     const dealii::IndexSet& also) {
  // What this rank's cells add to rows of others, before those rows are completed.
  dealii::IndexSet others = relevant;
  others.subtract_set(owned);
  std::map<global_dof_index, std::vector<global_dof_index>> foreign;
  for (const global_dof_index row : others) {
    const auto n = pattern.row_length(row);
    for (unsigned int k = 0; k < n; ++k) foreign[row].push_back(pattern.column_number(row, k));
  }
  dealii::SparsityTools::distribute_sparsity_pattern(pattern, owned, comm, relevant);

  dealii::IndexSet ghosts = relevant;
  if (also.size() > 0) ghosts.add_indices(also);
  // Gathered and sorted first: an index set takes a sorted range in one pass, single ones by moving the rest.
  std::vector<global_dof_index> beyond;
  for (const global_dof_index row : owned)
    for (unsigned int k = 0; k < pattern.row_length(row); ++k)
      if (const auto c = pattern.column_number(row, k); !owned.is_element(c)) beyond.push_back(c);
  std::sort(beyond.begin(), beyond.end());
  beyond.erase(std::unique(beyond.begin(), beyond.end()), beyond.end());
  ghosts.add_indices(beyond.begin(), beyond.end());
  ghosts.subtract_set(owned);
  partitioner = std::make_shared<dealii::Utilities::MPI::Partitioner>(owned, ghosts, comm);

  const auto append = [this](const std::vector<global_dof_index>& columns) {
    const auto begin = column.size();
    for (const auto c : columns) column.push_back(partitioner->global_to_local(c));
    std::sort(column.begin() + begin, column.end());
    row_start.push_back(column.size());
  };
  row_start.push_back(0);
  std::vector<global_dof_index> columns;
  for (const global_dof_index row : owned) {
    columns.clear();
    for (unsigned int k = 0; k < pattern.row_length(row); ++k)
      columns.push_back(pattern.column_number(row, k));
    append(columns);
  }
  for (const global_dof_index row : ghosts) append(foreign[row]);
  for (std::uint32_t row = 0; row < n_owned(); ++row) diagonal.push_back(position(row, row));

  // Ghosts ascend and so do their owners: the rows of one owner are one range of the value array.
  dealii::IndexSet asked = ghosts;
  const auto owner = dealii::Utilities::MPI::compute_index_owner(owned, asked, comm);
  std::map<unsigned int, std::vector<global_dof_index>> outgoing;
  std::uint32_t k = 0;
  for (const global_dof_index row : ghosts) {
    const std::uint32_t local = n_owned() + k, begin = row_start[local], end = row_start[local + 1];
    const unsigned int rank = owner[k++];
    if (begin == end) continue;
    if (sent.empty() || sent.back().rank != static_cast<int>(rank))
      sent.push_back({static_cast<int>(rank), begin, end, {}});
    sent.back().end = end;
    auto& list = outgoing[rank];
    list.push_back(row);
    list.push_back(end - begin);
    for (auto c = begin; c < end; ++c) list.push_back(partitioner->local_to_global(column[c]));
  }
  for (const auto& [rank, list] : dealii::Utilities::MPI::some_to_some(comm, outgoing)) {
    received.push_back({static_cast<int>(rank), 0, 0, {}});
    for (std::size_t i = 0; i < list.size(); i += 2 + list[i + 1])
      for (std::size_t c = 0; c < list[i + 1]; ++c)
        received.back().position.push_back(
            position(partitioner->global_to_local(list[i]), partitioner->global_to_local(list[i + 2 + c])));
  }
}

std::uint32_t SparsityStructure::position(std::uint32_t row, std::uint32_t col) const {
  const auto end = column.begin() + row_start[row + 1];
  return std::lower_bound(column.begin() + row_start[row], end, col) - column.begin();
}

SparseMatrix::SparseMatrix(std::shared_ptr<const SparsityStructure> structure)
    : value(structure->column.size()), shape(std::move(structure)) {}

void SparseMatrix::set_zero() {
  std::fill(value.begin(), value.end(), 0.0);
}

void SparseMatrix::compress() {
  const MPI_Comm comm = shape->partitioner->get_mpi_communicator();
  constexpr int tag = 4711;
  std::size_t n = 0;
  for (const auto& m : shape->received) n += m.position.size();
  buffer.resize(n);
  std::vector<MPI_Request> requests;
  n = 0;
  for (const auto& m : shape->received) {
    requests.emplace_back();
    MPI_Irecv(buffer.data() + n, m.position.size(), MPI_DOUBLE, m.rank, tag, comm, &requests.back());
    n += m.position.size();
  }
  for (const auto& m : shape->sent) {
    requests.emplace_back();
    MPI_Isend(value.data() + m.begin, m.end - m.begin, MPI_DOUBLE, m.rank, tag, comm, &requests.back());
  }
  MPI_Waitall(requests.size(), requests.data(), MPI_STATUSES_IGNORE);
  n = 0;
  for (const auto& m : shape->received)
    for (const auto position : m.position) value[position] += buffer[n++];
}

namespace {

template <int n>
void multiply_rows(const SparsityStructure& s, const double* value, NodalVector* const* y,
                   const NodalVector* const* x) {
  const double* in[n];
  double* out[n];
  for (int d = 0; d < n; ++d) {
    in[d] = x[d]->begin();
    out[d] = y[d]->begin();
  }
  const std::uint32_t *start = s.row_start.data(), *column = s.column.data();
  for (std::uint32_t row = 0; row < s.n_owned(); ++row) {
    for (int d = 0; d < n; ++d)
      out[d][row] = row_sum<double>(start[row], start[row + 1],
                                    [&](std::uint32_t k) { return value[k] * in[d][column[k]]; });
  }
}

}  // namespace

void SparseMatrix::multiply(int n, NodalVector* const* y, const NodalVector* const* x) const {
  if (n == 1) multiply_rows<1>(*shape, value.data(), y, x);
  if (n == 2) multiply_rows<2>(*shape, value.data(), y, x);
  if (n == 3) multiply_rows<3>(*shape, value.data(), y, x);
  if (!more) return;
  for (std::size_t r = 0; r < more->row.size(); ++r)
    for (int d = 0; d < n; ++d) {
      double sum = 0;
      for (std::uint32_t k = more->start[r]; k < more->start[r + 1]; ++k)
        sum += patch_value[k] * x[d]->local_element(more->column[k]);
      y[d]->local_element(more->row[r]) += sum;
    }
}

void SparseMatrix::set_patch(std::shared_ptr<const PatchStructure> places) {
  more = std::move(places);
  patch_value.assign(more ? more->column.size() : 0, 0.0);
}

double SparseMatrix::diagonal(std::uint32_t row) const {
  double d = value[shape->diagonal[row]];
  if (more && more->index[row] >= 0) d += patch_value[more->diagonal[more->index[row]]];
  return d;
}

SparseMatrix::Rows SparseMatrix::merged() const {
  Rows rows;
  const SparsityStructure& s = *shape;
  rows.start.push_back(0);
  std::vector<std::pair<std::uint32_t, double>> entries;
  for (std::uint32_t row = 0; row < s.n_owned(); ++row) {
    entries.clear();
    for (std::uint32_t k = s.row_start[row]; k < s.row_start[row + 1]; ++k)
      entries.emplace_back(s.column[k], value[k]);
    if (more && more->index[row] >= 0) {
      const std::uint32_t r = more->index[row];
      for (std::uint32_t k = more->start[r]; k < more->start[r + 1]; ++k)
        entries.emplace_back(more->column[k], patch_value[k]);
      std::sort(entries.begin(), entries.end(),
                [](const auto& a, const auto& b) { return a.first < b.first; });
    }
    for (const auto& [column, a] : entries) {
      if (rows.column.size() > rows.start.back() && rows.column.back() == column) {
        rows.value.back() += a;
      } else {
        rows.column.push_back(column);
        rows.value.push_back(a);
      }
    }
    rows.start.push_back(rows.column.size());
  }
  return rows;
}

double SparseMatrix::row_times(std::uint32_t row, const NodalVector& x) const {
  const double* in = x.begin();
  double sum = row_sum<double>(shape->row_start[row], shape->row_start[row + 1],
                               [&](std::uint32_t k) { return value[k] * in[shape->column[k]]; });
  if (more && more->index[row] >= 0) {
    const std::uint32_t r = more->index[row];
    for (std::uint32_t k = more->start[r]; k < more->start[r + 1]; ++k)
      sum += patch_value[k] * x.local_element(more->column[k]);
  }
  return sum;
}

}  // namespace seedflow
