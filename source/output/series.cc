#include "seedflow/output/series.h"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>

#include "seedflow/base/error.h"
#include "seedflow/output/folder.h"

namespace seedflow {

namespace {

/// The fewest digits that read back to the same double.
std::string exact(double value) {
  char text[32];
  return std::string(text, std::to_chars(text, text + sizeof text, value).ptr);
}

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \t\r");
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0;;) {
    const std::size_t end = text.find(separator, begin);
    parts.push_back(trimmed(text.substr(begin, end - begin)));
    if (end == std::string::npos) return parts;
    begin = end + 1;
  }
}

std::string header(const std::vector<Column>& columns) {
  std::string line;
  for (const Column& column : columns) {
    if (column.name.empty() || (column.name + column.unit).find_first_of(",\n[]") != std::string::npos)
      throw RunError("'" + column.name + " [" + column.unit + "]' cannot be the heading of a CSV column.");
    line += (line.empty() ? "" : ",") + column.name + " [" + column.unit + "]";
  }
  return line + "\n";
}

std::vector<Column> parse_header(const std::string& line) {
  std::vector<Column> columns;
  for (const std::string& field : split(line, ',')) {
    const auto open = field.rfind('[');
    if (open == std::string::npos || field.back() != ']')
      columns.push_back({field, "1"});
    else
      columns.push_back({trimmed(field.substr(0, open)), field.substr(open + 1, field.size() - open - 2)});
  }
  return columns;
}

double parse_number(const std::string& field, const std::string& where) {
  const char* begin = field.data();
  if (!field.empty() && *begin == '+') ++begin;
  double value = 0;
  const auto [end, error] = std::from_chars(begin, field.data() + field.size(), value);
  if (error != std::errc() || end != field.data() + field.size())
    throw InputError(where + ": '" + field + "' is not a number.");
  return value;
}

std::string format_row(const std::vector<double>& values) {
  std::string line;
  for (const double value : values) line += (line.empty() ? "" : ",") + exact(value);
  return line + "\n";
}

Series parse_series(const std::string& text, const std::string& name) {
  Series series;
  int number = 0;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string line = trimmed(text.substr(begin, end - begin));
    begin = end + 1;
    ++number;
    if (line.empty() || line[0] == '#') continue;
    if (series.columns.empty()) {
      series.columns = parse_header(line);
      series.values.resize(series.columns.size());
      continue;
    }
    const std::string where = "'" + name + "', line " + std::to_string(number);
    const std::vector<std::string> fields = split(line, ',');
    if (fields.size() != series.columns.size())
      throw InputError(where + ": " + std::to_string(fields.size()) + " values where the header has " +
                       std::to_string(series.columns.size()) + " columns.");
    for (std::size_t c = 0; c < fields.size(); ++c)
      series.values[c].push_back(
          parse_number(fields[c], where + ", column '" + series.columns[c].name + "'"));
  }
  if (series.columns.empty())
    throw InputError("'" + name + "' is empty: a header line 'name [unit],...' is needed.");
  return series;
}

}  // namespace

SeriesWriter::SeriesWriter(const std::filesystem::path& file_, std::vector<Column> columns_)
    : file(file_), columns(std::move(columns_)) {
  const std::string first = header(columns);
  stream.reset(std::fopen(file.c_str(), "wb"));
  write(first);
}

SeriesWriter::SeriesWriter(const std::filesystem::path& file_, std::vector<Column> columns_,
                           double resume_time)
    : file(file_), columns(std::move(columns_)) {
  std::string text = read_file(file);
  // A row without its line break was cut off by the interruption; its last number may be too short.
  text.resize(text.rfind('\n') == std::string::npos ? 0 : text.rfind('\n') + 1);
  const std::string first = header(columns);
  if (text.compare(0, first.size(), first) != 0)
    throw InputError("'" + file.string() + "' cannot be continued: its columns are '" +
                     text.substr(0, text.find('\n')) + "', this run writes '" +
                     first.substr(0, first.size() - 1) +
                     "'. Start without --resume or with another output folder.");
  const Series old = parse_series(text, file.string());
  std::string kept = first;
  for (std::size_t row = 0; row < old.n_rows(); ++row) {
    if (old.values[0][row] > resume_time) continue;
    std::vector<double> values;
    for (const auto& column : old.values) values.push_back(column[row]);
    kept += format_row(values);
  }
  write_file_atomically(file, kept);
  stream.reset(std::fopen(file.c_str(), "ab"));
  write("");
}

void SeriesWriter::row(const std::vector<double>& values) {
  if (values.size() != columns.size())
    throw RunError("'" + file.string() + "': " + std::to_string(values.size()) + " values for " +
                   std::to_string(columns.size()) + " columns.");
  for (std::size_t c = 0; c < values.size(); ++c)
    if (!std::isfinite(values[c]))
      throw RunError("'" + file.string() + "': " + columns[c].name + " is " + exact(values[c]) + " at " +
                     columns[0].name + " " + exact(values[0]) + " " + columns[0].unit + ".");
  write(format_row(values));
}

void SeriesWriter::write(const std::string& text) {
  if (!stream || std::fwrite(text.data(), 1, text.size(), stream.get()) != text.size() ||
      std::fflush(stream.get()) != 0)
    throw RunError("Cannot write '" + file.string() + "': " + std::strerror(errno) + ".");
}

const std::vector<double>& Series::operator[](const std::string& name) const {
  std::string names;
  for (std::size_t c = 0; c < columns.size(); ++c) {
    if (columns[c].name == name) return values[c];
    names += (c == 0 ? "'" : ", '") + columns[c].name + "'";
  }
  throw InputError("There is no column '" + name + "'; there are " + names + ".");
}

Series read_series(const std::filesystem::path& file) {
  return parse_series(read_file(file), file.string());
}

void write_series(const std::filesystem::path& file, const Series& series) {
  std::string text = header(series.columns);
  for (std::size_t row = 0; row < series.n_rows(); ++row) {
    std::vector<double> values;
    for (const auto& column : series.values) values.push_back(column.at(row));
    text += format_row(values);
  }
  write_file_atomically(file, text);
}

}  // namespace seedflow
