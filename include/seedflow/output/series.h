#pragma once

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace seedflow {

/// One column of a table of numbers. In a CSV header it reads "velocity z [m/s]".
struct Column {
  std::string name;
  std::string unit = "1";  ///< SI; "1" for none
};

/// Writes a time series as CSV: a header line with names and units, then one row per call, flushed, so that
/// the file can be followed while the run goes on. The first column is the time. Numbers read back to the
/// same double.
///
/// Only one rank may own the writer of a file.
/// Errors: RunError if the disk is full, a value is not finite or the number of values is wrong.
class SeriesWriter {
 public:
  /// Begins a new file (an old one is overwritten).
  SeriesWriter(const std::filesystem::path& file, std::vector<Column> columns);
  /// Continues a file: rows later than `resume_time` [s], and a last row cut off in the middle, are removed,
  /// further rows appended. Errors: InputError if the file is missing or has other columns.
  SeriesWriter(const std::filesystem::path& file, std::vector<Column> columns, double resume_time);

  void row(const std::vector<double>& values);

  const std::filesystem::path& path() const { return file; }

 private:
  void write(const std::string& text);

  struct Close {
    void operator()(std::FILE* f) const { std::fclose(f); }
  };
  std::filesystem::path file;
  std::vector<Column> columns;
  std::unique_ptr<std::FILE, Close> stream;
};

/// A table of numbers by columns, as read from a CSV.
struct Series {
  std::vector<Column> columns;
  std::vector<std::vector<double>> values;  ///< values[c][row], one vector per column

  std::size_t n_rows() const { return values.empty() ? 0 : values[0].size(); }
  /// The values of the column called `name`. Errors: InputError listing the names there are.
  const std::vector<double>& operator[](const std::string& name) const;
};

/// Reads a CSV with a header "name [unit],..." (no unit in brackets: unit "1"; lines starting with # are
/// comments). Errors: InputError with file and line for a missing file, a row of another length, a field that
/// is no number.
Series read_series(const std::filesystem::path& file);

/// Writes a whole table at once, atomically, in the same format.
void write_series(const std::filesystem::path& file, const Series& series);

}  // namespace seedflow
