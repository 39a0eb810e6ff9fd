#include "seedflow/experiment/csv_rows.h"

#include <algorithm>
#include <sstream>

#include "seedflow/base/error.h"
#include "seedflow/base/trim.h"
#include "seedflow/output/folder.h"

namespace seedflow {

namespace {

bool all_empty(const std::vector<std::string>& fields) {
  return std::all_of(fields.begin(), fields.end(), [](const std::string& f) { return f.empty(); });
}

}  // namespace

std::vector<std::string> csv_fields(const std::string& line, const std::string& where) {
  std::vector<std::string> fields(1);
  bool quoted = false, was_quoted = false;
  const auto finish = [&] {
    if (!was_quoted) fields.back() = trim(fields.back());
    was_quoted = false;
  };
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (quoted) {
      if (line[i] != '"')
        fields.back() += line[i];
      else if (i + 1 < line.size() && line[i + 1] == '"')
        fields.back() += line[i++];
      else
        quoted = false;
    } else if (line[i] == '"' && trim(fields.back()).empty()) {
      quoted = was_quoted = true;
      fields.back().clear();
    } else if (line[i] == ',') {
      finish();
      fields.emplace_back();
    } else if (!was_quoted || trim(std::string(1, line[i])) != "") {
      fields.back() += line[i];
    }
  }
  if (quoted) throw InputError(where + ": a quotation mark is not closed.");
  finish();
  return fields;
}

CsvRows::CsvRows(const std::filesystem::path& file) : file(file), head{0, {}} {
  std::string content = read_file(file);
  if (content.compare(0, 3, "\xEF\xBB\xBF") == 0) content.erase(0, 3);  // byte order mark
  for (std::size_t i = 0; i < content.size(); ++i)
    if (content[i] == '\r' && (i + 1 == content.size() || content[i + 1] != '\n')) content[i] = '\n';
  std::istringstream text(content);
  std::string line;
  for (int number = 1; std::getline(text, line); ++number) {
    line = trim(line);
    if (line.empty() || line[0] == '#' || line.compare(0, 2, "\"#") == 0) continue;
    Row row{number, csv_fields(line, where(number))};
    if (all_empty(row.fields)) continue;
    if (head.line > 0) {
      below.push_back(row);
      continue;
    }
    for (const char separator : {';', '\t'})
      if (row.fields.size() == 1 && line.find(separator) != std::string::npos)
        throw InputError(where(number) + ": the columns are separated by " +
                         (separator == ';' ? "semicolons" : "tabs") +
                         ". Write commas between them, and points in numbers.");
    head = row;
  }
  if (head.line == 0) throw InputError(file.string() + ": the file is empty.");
  // Spreadsheets keep empty columns on the right.
  const auto trim_right = [](std::vector<std::string>& fields, std::size_t least) {
    while (fields.size() > least && fields.back().empty()) fields.pop_back();
  };
  trim_right(head.fields, 1);
  const std::size_t n = head.fields.size();
  for (Row& row : below) {
    trim_right(row.fields, n);
    if (row.fields.size() != n)
      throw InputError(where(row.line) + ": " + std::to_string(row.fields.size()) +
                       " fields, but the header has " + std::to_string(n) + ".");
  }
  for (std::size_t c = 0; c < n; ++c)
    if (column(head.fields[c]) != static_cast<int>(c))
      throw InputError(where(head.line) + ": the column \"" + head.fields[c] + "\" stands there twice.");
}

int CsvRows::column(const std::string& name) const {
  const auto found = std::find(head.fields.begin(), head.fields.end(), name);
  return found == head.fields.end() ? -1 : static_cast<int>(found - head.fields.begin());
}

std::string CsvRows::where(int line) const {
  return file.string() + ":" + std::to_string(line);
}

}  // namespace seedflow
