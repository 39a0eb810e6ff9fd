#include "seedflow/experiment/measurements.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <set>
#include <sstream>
#include <tuple>

#include "seedflow/base/error.h"
#include "seedflow/base/trim.h"
#include "seedflow/base/units.h"
#include "seedflow/experiment/csv_rows.h"
#include "seedflow/output/folder.h"

namespace seedflow {

namespace {

double to_number(const std::string& text, const std::string& where, const std::string& what) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0' || !std::isfinite(value))
    throw InputError(where + ": " + what + " \"" + text + "\" is not a finite number.");
  return value;
}

/// A number in the unit of the value, or "2 %" of the value.
double to_uncertainty(const std::string& text, double value, const std::string& where) {
  const bool percent = !text.empty() && text.back() == '%';
  const double number =
      to_number(trim(percent ? text.substr(0, text.size() - 1) : text), where, "the standard uncertainty");
  const double uncertainty = percent ? 0.01 * number * std::abs(value) : number;
  if (!(uncertainty > 0))
    throw InputError(where + ": the standard uncertainty " + text +
                     (percent ? " of " + exact_text(value) : "") +
                     " must be positive. If it is not known, estimate it; zero would mean a perfect "
                     "measurement.");
  return uncertainty;
}

/// held_out; nothing means no.
bool is_yes(std::string text, const std::string& where) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (text == "yes" || text == "true") return true;
  if (text.empty() || text == "no" || text == "false") return false;
  throw InputError(where + ": held_out must be yes or no, not \"" + text + "\".");
}

const std::vector<std::string> names = {
    "condition", "quantity", "unit", "coordinate", "coordinate_unit", "value", "standard_uncertainty"};

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
    const std::vector<std::string> f = csv_fields(trim(line.substr(1)), where);
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

/// Errors: InputError if a part belongs to no value.
void add_correlated_parts(const std::vector<CorrelatedPart>& parts, const std::filesystem::path& file,
                          std::vector<Measurement>& measurements) {
  for (const CorrelatedPart& part : parts) {
    const std::string where = file.string() + ":" + std::to_string(part.line);
    bool used = false;
    for (Measurement& m : measurements) {
      if (m.quantity != part.quantity) continue;
      m.correlated_unit = part.unit, m.correlated_coordinate_unit = part.coordinate_unit;
      m.correlated_where = where;
      m.correlated_uncertainty = part.uncertainty;
      m.correlation_length = part.length;
      used = true;
    }
    if (!used) throw InputError(where + ": no value of \"" + part.quantity + "\" stands in the file.");
  }
}

}  // namespace

std::string Measurement::where() const {
  return file + ":" + std::to_string(line);
}

std::vector<Measurement> read_measurements(const std::filesystem::path& file) {
  const CsvRows csv(file);
  const std::string head = csv.where(csv.header().line);
  std::string all;
  for (const std::string& name : names) all += (all.empty() ? "" : ",") + name;
  for (const std::string& name : names) {
    const bool may_lack = name.rfind("coordinate", 0) == 0;
    if (csv.column(name) < 0 && !may_lack)
      throw InputError(head + ": the column \"" + name + "\" is missing. The columns are " + all + ".");
  }
  for (const std::string& name : csv.header().fields)
    if (std::find(names.begin(), names.end(), name) == names.end())
      throw InputError(head + ": there is no column \"" + name + "\". The columns are " + all + ".");
  if (csv.rows().empty()) throw InputError(file.string() + ": there is no measurement below the header.");
  std::vector<Measurement> result;
  std::set<std::tuple<std::string, std::string, double, double>> seen;
  for (const CsvRows::Row& row : csv.rows()) {
    const std::string where = csv.where(row.line);
    const auto field = [&](const char* name) {
      const int c = csv.column(name);
      return c < 0 ? std::string() : row.fields[c];
    };
    Measurement m;
    m.condition = field("condition"), m.quantity = field("quantity"), m.unit = field("unit");
    m.coordinate_unit = field("coordinate_unit"), m.line = row.line;
    m.file = file.string();
    m.coordinate = std::numeric_limits<double>::quiet_NaN();
    for (const char* needed : {"condition", "quantity"})
      if (field(needed).empty()) throw InputError(where + ": the " + needed + " is missing.");
    if (m.unit.empty())
      throw InputError(where + ": " + m.quantity + " has no unit. Write 1 for a pure number.");
    const std::string coordinate = field("coordinate");
    if (coordinate.empty() != m.coordinate_unit.empty())
      throw InputError(where + ": " +
                       (coordinate.empty() ? "the coordinate is missing, but its unit is given."
                                           : "the coordinate has no unit. Write 1 for a pure number."));
    if (!coordinate.empty()) m.coordinate = to_number(coordinate, where, "the coordinate");
    m.value = to_number(field("value"), where, "the value");
    m.standard_uncertainty = to_uncertainty(field("standard_uncertainty"), m.value, where);
    const double place = coordinate.empty() ? 0.0 : m.coordinate;
    if (!seen.insert({m.condition, m.quantity, place, m.value}).second)
      throw InputError(where + ": this point stands in the file twice.");
    result.push_back(m);
  }
  add_correlated_parts(read_correlated_parts(file), file, result);
  return result;
}

std::vector<Condition> read_conditions(const std::filesystem::path& file) {
  const CsvRows csv(file);
  const std::string head = csv.where(csv.header().line);
  const int name = csv.column("condition"), held_out = csv.column("held_out");
  if (name < 0)
    throw InputError(head +
                     ": the column \"condition\" is missing. The header is condition,held_out and one "
                     "column per entry that differs, as in Seeds/Diameter [mm].");
  struct Entry {
    std::size_t column;
    std::string path, unit;
  };
  std::vector<Entry> entries;
  for (std::size_t c = 0; c < csv.header().fields.size(); ++c) {
    if (static_cast<int>(c) == name || static_cast<int>(c) == held_out) continue;
    const std::string& text = csv.header().fields[c];
    const auto open = text.rfind('[');
    if (open == std::string::npos || text.back() != ']')
      throw InputError(head + ": column \"" + text +
                       "\" has no unit. Write it in brackets, as in Air/Density [kg/m3]; [1] for none.");
    const std::string unit = trim(text.substr(open + 1, text.size() - open - 2));
    entries.push_back({c, trim(text.substr(0, open)), unit == "1" || unit == "-" ? "" : " " + unit});
  }
  if (csv.rows().empty()) throw InputError(file.string() + ": there is no condition below the header.");
  std::vector<Condition> result;
  std::set<std::string> seen;
  for (const CsvRows::Row& row : csv.rows()) {
    const std::string where = csv.where(row.line);
    if (row.fields[name].empty()) throw InputError(where + ": the name of the condition is missing.");
    if (!seen.insert(row.fields[name]).second)
      throw InputError(where + ": the condition \"" + row.fields[name] + "\" stands here twice.");
    Condition condition{row.fields[name], held_out >= 0 && is_yes(row.fields[held_out], where), {}, where};
    for (const Entry& e : entries)
      if (!row.fields[e.column].empty())
        condition.overrides.push_back(e.path + "=" + row.fields[e.column] + e.unit);
    result.push_back(condition);
  }
  return result;
}

}  // namespace seedflow
