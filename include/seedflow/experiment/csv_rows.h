#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace seedflow {

/// A CSV file as people and spreadsheets write it: columns in any order, found by their names; comments (#),
/// empty lines and lines of nothing but commas left out; fields in double quotes, which may hold commas; a
/// byte order mark; line ends of any system.
class CsvRows {
 public:
  /// Errors: InputError, with the line, for an empty file, rows of another length than the header, other
  /// separators than commas, a column named twice.
  explicit CsvRows(const std::filesystem::path& file);

  struct Row {
    int line;  ///< of the file
    std::vector<std::string> fields;
  };
  const Row& header() const { return head; }
  const std::vector<Row>& rows() const { return below; }
  /// Index of a column, or -1.
  int column(const std::string& name) const;
  /// "file:line"
  std::string where(int line) const;

 private:
  std::filesystem::path file;
  Row head;
  std::vector<Row> below;
};

/// Fields of one line, trimmed, without their quotes. Errors: InputError for a quote that is not closed.
std::vector<std::string> csv_fields(const std::string& line, const std::string& where);

}  // namespace seedflow
