#include "seedflow/experiment/measurements.h"

#include <cmath>
#include <cstdlib>
#include <limits>
#include <set>
#include <sstream>
#include <tuple>

#include "seedflow/base/error.h"
#include "seedflow/output/folder.h"

namespace seedflow {

namespace {

std::string trim(const std::string& s) {
  const auto a = s.find_first_not_of(" \t\r"), b = s.find_last_not_of(" \t\r");
  return a == std::string::npos ? "" : s.substr(a, b - a + 1);
}

/// The rows of a CSV, comments and empty lines left out, each with its line number.
struct Row {
  int line;
  std::vector<std::string> fields;
};

std::vector<Row> read_rows(const std::filesystem::path& file) {
  std::istringstream text(read_file(file));
  std::vector<Row> rows;
  std::string line;
  for (int number = 1; std::getline(text, line); ++number) {
    line = trim(line);
    if (line.empty() || line[0] == '#') continue;
    Row row{number, {}};
    std::istringstream fields(line);
    for (std::string field; std::getline(fields, field, ',');) row.fields.push_back(trim(field));
    if (line.back() == ',') row.fields.push_back("");
    rows.push_back(row);
  }
  if (rows.empty()) throw InputError(file.string() + ": the file is empty.");
  for (const Row& row : rows)
    if (row.fields.size() != rows[0].fields.size())
      throw InputError(file.string() + ":" + std::to_string(row.line) + ": " +
                       std::to_string(row.fields.size()) + " fields, but the header has " +
                       std::to_string(rows[0].fields.size()) + ".");
  return rows;
}

double to_number(const std::string& text, const std::string& where, const std::string& what) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0' || !std::isfinite(value))
    throw InputError(where + ": " + what + " \"" + text + "\" is not a finite number.");
  return value;
}

}  // namespace

namespace {

/// What a line `# correlated,...` says.
struct CorrelatedPart {
  std::string quantity, unit, coordinate_unit;
  double uncertainty = 0, length = 0;
  int line = 0;
};

std::vector<CorrelatedPart> read_correlated_parts(const std::filesystem::path& file) {
  std::vector<CorrelatedPart> parts;
  std::istringstream text(read_file(file));
  std::string line;
  for (int number = 1; std::getline(text, line); ++number) {
    line = trim(line);
    if (line.empty() || line[0] != '#' || trim(line.substr(1)).compare(0, 11, "correlated,") != 0) continue;
    const std::string where = file.string() + ":" + std::to_string(number);
    std::vector<std::string> f;
    std::istringstream fields(trim(line.substr(1)));
    for (std::string field; std::getline(fields, field, ',');) f.push_back(trim(field));
    if (f.size() != 6)
      throw InputError(where +
                       ": write # correlated,QUANTITY,UNIT,UNCERTAINTY,COORDINATE_UNIT,LENGTH, for example # "
                       "correlated,velocity,m/s,0.001,s,0.5.");
    CorrelatedPart part{f[1], f[2], f[4], to_number(f[3], where, "the uncertainty"), 0, number};
    part.length = f[5] == "inf" ? std::numeric_limits<double>::infinity()
                                : to_number(f[5], where, "the correlation length");
    if (!(part.uncertainty > 0) || !(part.length > 0))
      throw InputError(where + ": uncertainty and correlation length must be positive.");
    parts.push_back(part);
  }
  return parts;
}

/// Errors: InputError if a part belongs to no value, or is written in other units than the values.
void add_correlated_parts(const std::vector<CorrelatedPart>& parts, const std::filesystem::path& file,
                          std::vector<Measurement>& measurements) {
  for (const CorrelatedPart& part : parts) {
    const std::string where = file.string() + ":" + std::to_string(part.line);
    bool used = false;
    for (Measurement& m : measurements) {
      if (m.quantity != part.quantity) continue;
      if (m.unit != part.unit || m.coordinate_unit != part.coordinate_unit)
        throw InputError(where + ": the correlated part must be given in the units of the values of " +
                         part.quantity + ", " + m.unit + " and " + m.coordinate_unit + ".");
      m.correlated_uncertainty = part.uncertainty;
      m.correlation_length = part.length;
      used = true;
    }
    if (!used) throw InputError(where + ": no value of \"" + part.quantity + "\" stands in the file.");
  }
}

}  // namespace

std::vector<Measurement> read_measurements(const std::filesystem::path& file) {
  const std::vector<Row> rows = read_rows(file);
  const std::vector<std::string> header = {
      "condition", "quantity", "unit", "coordinate", "coordinate_unit", "value", "standard_uncertainty"};
  if (rows[0].fields != header)
    throw InputError(file.string() + ":" + std::to_string(rows[0].line) +
                     ": the header must be condition,quantity,unit,coordinate,coordinate_unit,value,"
                     "standard_uncertainty.");
  if (rows.size() == 1) throw InputError(file.string() + ": there is no measurement below the header.");
  std::vector<Measurement> result;
  std::set<std::tuple<std::string, std::string, double, double>> seen;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const auto& f = rows[i].fields;
    const std::string where = file.string() + ":" + std::to_string(rows[i].line);
    Measurement m;
    m.condition = f[0], m.quantity = f[1], m.unit = f[2], m.coordinate_unit = f[4], m.line = rows[i].line;
    m.coordinate = std::numeric_limits<double>::quiet_NaN();
    for (const int needed : {0, 1})
      if (f[needed].empty()) throw InputError(where + ": the " + header[needed] + " is missing.");
    if (f[2].empty()) throw InputError(where + ": " + f[1] + " has no unit. Write 1 for a pure number.");
    if (f[3].empty() != f[4].empty())
      throw InputError(where + ": " +
                       (f[3].empty() ? "the coordinate is missing, but its unit is given."
                                     : "the coordinate has no unit. Write 1 for a pure number."));
    if (!f[3].empty()) m.coordinate = to_number(f[3], where, "the coordinate");
    m.value = to_number(f[5], where, "the value");
    m.standard_uncertainty = to_number(f[6], where, "the standard uncertainty");
    if (!(m.standard_uncertainty > 0))
      throw InputError(
          where + ": the standard uncertainty " + f[6] +
          " must be positive. If it is not known, estimate it; zero would mean a perfect measurement.");
    const double place = f[3].empty() ? 0.0 : m.coordinate;
    if (!seen.insert({f[0], f[1], place, m.value}).second)
      throw InputError(where + ": this point stands in the file twice.");
    result.push_back(m);
  }
  add_correlated_parts(read_correlated_parts(file), file, result);
  return result;
}

std::vector<Condition> read_conditions(const std::filesystem::path& file) {
  const std::vector<Row> rows = read_rows(file);
  const std::vector<std::string>& header = rows[0].fields;
  const std::string head = file.string() + ":" + std::to_string(rows[0].line);
  if (header.size() < 2 || header[0] != "condition" || header[1] != "held_out")
    throw InputError(head + ": the header must begin with condition,held_out.");
  std::vector<std::string> path, unit;
  for (std::size_t c = 2; c < header.size(); ++c) {
    const auto open = header[c].rfind('[');
    if (open == std::string::npos || header[c].back() != ']')
      throw InputError(head + ": column \"" + header[c] +
                       "\" has no unit. Write it in brackets, as in Air/Density [kg/m3]; [1] for none.");
    path.push_back(trim(header[c].substr(0, open)));
    unit.push_back(header[c].substr(open + 1, header[c].size() - open - 2));
  }
  if (rows.size() == 1) throw InputError(file.string() + ": there is no condition below the header.");
  std::vector<Condition> result;
  std::set<std::string> seen;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const auto& f = rows[i].fields;
    const std::string where = file.string() + ":" + std::to_string(rows[i].line);
    if (f[0].empty()) throw InputError(where + ": the name of the condition is missing.");
    if (f[1] != "yes" && f[1] != "no")
      throw InputError(where + ": held_out must be yes or no, not \"" + f[1] + "\".");
    if (!seen.insert(f[0]).second)
      throw InputError(where + ": the condition \"" + f[0] + "\" stands here twice.");
    Condition condition{f[0], f[1] == "yes", {}};
    for (std::size_t c = 0; c < path.size(); ++c)
      condition.overrides.push_back(path[c] + "=" + f[c + 2] + (unit[c] == "1" ? "" : " " + unit[c]));
    result.push_back(condition);
  }
  return result;
}

}  // namespace seedflow
