#include "seedflow/base/units.h"

#include <charconv>
#include <cmath>
#include <limits>
#include <map>

#include "seedflow/base/error.h"
#include "seedflow/base/nearest_name.h"

namespace seedflow {
namespace {

constexpr double pi = 3.14159265358979323846;

struct NamedUnit {
  Unit unit;
  bool takes_prefix;
};

/// Length, mass, time, temperature, angle; factor; power of ten; offset. BIPM, The International System of
/// Units, 9th ed. (2019), tables 2, 4, 5 and 8 (non-SI units accepted for use with the SI).
const std::map<std::string, NamedUnit>& named_units() {
  static const std::map<std::string, NamedUnit> units = {
      {"1", {{{}}, false}},
      {"%", {{{}, 1, -2}, false}},
      {"m", {{{1, 0, 0, 0, 0}}, true}},
      {"g", {{{0, 1, 0, 0, 0}, 1, -3}, true}},
      {"t", {{{0, 1, 0, 0, 0}, 1, 3}, false}},
      {"s", {{{0, 0, 1, 0, 0}}, true}},
      {"min", {{{0, 0, 1, 0, 0}, 60}, false}},
      {"h", {{{0, 0, 1, 0, 0}, 3600}, false}},
      {"Hz", {{{0, 0, -1, 0, 0}}, true}},
      {"K", {{{0, 0, 0, 1, 0}}, false}},
      {"degC", {{{0, 0, 0, 1, 0}, 1, 0, 273.15}, false}},
      {"\xc2\xb0"
       "C",
       {{{0, 0, 0, 1, 0}, 1, 0, 273.15}, false}},
      {"rad", {{{0, 0, 0, 0, 1}}, false}},
      {"deg", {{{0, 0, 0, 0, 1}, pi / 180}, false}},
      {"\xc2\xb0", {{{0, 0, 0, 0, 1}, pi / 180}, false}},
      {"rev", {{{0, 0, 0, 0, 1}, 2 * pi}, false}},
      {"rpm", {{{0, 0, -1, 0, 1}, 2 * pi / 60}, false}},
      {"N", {{{1, 1, -2, 0, 0}}, true}},
      {"Pa", {{{-1, 1, -2, 0, 0}}, true}},
      {"bar", {{{-1, 1, -2, 0, 0}, 1, 5}, false}},
      {"mbar", {{{-1, 1, -2, 0, 0}, 1, 2}, false}},
      {"J", {{{2, 1, -2, 0, 0}}, true}},
      {"W", {{{2, 1, -3, 0, 0}}, true}},
      {"L", {{{3, 0, 0, 0, 0}, 1, -3}, true}},
      {"P", {{{-1, 1, -1, 0, 0}, 1, -1}, false}},
      {"cP", {{{-1, 1, -1, 0, 0}, 1, -3}, false}},
  };
  return units;
}

/// What is worth naming in a message, by dimension.
const std::vector<std::string>& common_units() {
  static const std::vector<std::string> units = {
      "1",   "%",    "m",    "mm",   "um",    "cm",    "km",     "m2",    "mm2",  "m3",    "mm3",   "L",
      "mL",  "kg",   "g",    "mg",   "t",     "s",     "ms",     "us",    "min",  "h",     "1/s",   "Hz",
      "kHz", "m/s",  "mm/s", "km/h", "m/s2",  "K",     "degC",   "rad",   "deg",  "rev",   "rad/s", "deg/s",
      "rpm", "N",    "mN",   "kN",   "N/m",   "N/mm",  "N m",    "N mm",  "N/m3", "Pa",    "kPa",   "MPa",
      "GPa", "mbar", "bar",  "Pa/m", "kPa/m", "Pa s",  "mPa s",  "cP",    "m2/s", "mm2/s", "J",     "mJ",
      "W",   "kW",   "kg/s", "g/s",  "g/min", "kg/h",  "kg/m3",  "g/cm3", "g/L",  "m3/s",  "L/min", "m3/h",
      "1/m", "1/mm", "1/m3", "J/m2", "mJ/m2", "N s/m", "N m/rad"};
  return units;
}

class UnitReader {
 public:
  explicit UnitReader(const std::string& text) : text(text) {}

  Unit read() {
    const Unit unit = product();
    if (position != text.size()) fail("it does not read as a unit");
    return unit;
  }

 private:
  const std::string& text;
  std::size_t position = 0;

  [[noreturn]] void fail(const std::string& why) const {
    throw InputError(
        "unit \"" + text + "\": " + why +
        ". Write products with a space and quotients with '/', for example \"kg/m3\" or \"mPa s\".");
  }

  char peek() const { return position < text.size() ? text[position] : '\0'; }
  bool skip_blanks() {
    const std::size_t begin = position;
    while (peek() == ' ') ++position;
    return position > begin;
  }

  static void multiply(Unit& a, const Unit& b, int power) {
    for (std::size_t d = 0; d < a.dimension.size(); ++d) a.dimension[d] += power * b.dimension[d];
    a.factor *= std::pow(b.factor, power);
    a.exponent += power * b.exponent;
  }

  Unit product() {
    Unit unit;
    int power = 1, factors = 0;
    bool divided = false;
    for (;;) {
      skip_blanks();
      const Unit factor = power_of_unit();
      ++factors;
      if (factor.offset != 0 && (factors > 1 || position != text.size()))
        fail("degC is a scale, not a difference; write K in a product or quotient");
      multiply(unit, factor, power);
      if (factor.offset != 0) unit.offset = factor.offset;
      const bool blank = skip_blanks();
      if (peek() == '/') {
        ++position;
        power = -1;
        divided = true;
      } else if (peek() == '*' || (blank && peek() != '\0' && peek() != ')')) {
        if (peek() == '*') ++position;
        if (divided) fail("a product after '/' can be read in two ways; use parentheses, as in \"J/(kg K)\"");
        power = 1;
      } else {
        return unit;
      }
    }
  }

  Unit power_of_unit() {
    Unit base;
    if (peek() == '(') {
      ++position;
      base = product();
      if (peek() != ')') fail("a parenthesis is not closed");
      ++position;
    } else {
      base = symbol();
    }
    const std::size_t before_caret = position;
    if (peek() == '^') ++position;
    int power = 1;
    const auto [end, error] = std::from_chars(text.data() + position, text.data() + text.size(), power);
    if (error == std::errc())
      position = static_cast<std::size_t>(end - text.data());
    else if (position != before_caret)
      fail("'^' is not followed by an integer");
    if (power == 1) return base;
    Unit result;
    multiply(result, base, power);
    return result;
  }

  Unit symbol() {
    if (peek() == '%' || peek() == '1') {
      const std::string name(1, text[position++]);
      return named_units().at(name).unit;
    }
    const std::size_t begin = position;
    const auto is_letter = [](char c) {
      return std::isalpha(static_cast<unsigned char>(c)) || (c & 0x80) != 0;
    };
    while (is_letter(peek())) ++position;
    std::string name = text.substr(begin, position - begin);
    if (name.empty())
      fail(begin == text.size() ? "a unit is missing at its end" : "it does not read as a unit");
    for (const char* micro : {"\xc2\xb5", "\xce\xbc"})  // both Unicode spellings of the sign for micro
      if (name.compare(0, 2, micro) == 0) name.replace(0, 2, "u");
    const auto& units = named_units();
    if (const auto found = units.find(name); found != units.end()) return found->second.unit;
    static const std::map<char, int> prefixes = {{'n', -9}, {'u', -6}, {'m', -3}, {'c', -2},
                                                 {'k', 3},  {'M', 6},  {'G', 9}};
    const auto prefix = prefixes.find(name[0]);
    const auto stem = units.find(name.substr(1));
    if (prefix != prefixes.end() && stem != units.end() && stem->second.takes_prefix) {
      Unit unit = stem->second.unit;
      unit.exponent += prefix->second;
      return unit;
    }
    std::vector<std::string> names;
    for (const auto& [key, value] : units) names.push_back(key);
    fail("\"" + name + "\" is not a known unit. " + suggestion(name, names, "unit"));
  }
};

std::string join(const std::vector<std::string>& names) {
  std::string text;
  for (const auto& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

}  // namespace

Unit parse_unit(const std::string& text) {
  if (text == "-") return {};  // how tables write a pure number
  return UnitReader(text).read();
}

NumberWithUnit split_unit(const std::string& text) {
  std::size_t begin = text.find_first_not_of(" \t");
  std::size_t end = text.find_last_not_of(" \t");
  if (begin == std::string::npos) throw InputError("it is empty, a number is needed");
  ++end;
  std::size_t first = begin;
  if (text[first] == '+') ++first;
  double value = 0;
  const auto [stop, error] = std::from_chars(text.data() + first, text.data() + end, value);
  const std::string shown = text.substr(begin, end - begin);
  if (error == std::errc::result_out_of_range)
    throw InputError("\"" + shown + "\" is too large or too small");
  if (error != std::errc()) throw InputError("\"" + shown + "\" is not a number");
  if (!std::isfinite(value)) throw InputError("\"" + shown + "\" is not a finite number");
  const std::size_t number_end = static_cast<std::size_t>(stop - text.data());
  const std::size_t unit_begin = text.find_first_not_of(" \t", number_end);
  NumberWithUnit parts{text.substr(first, number_end - first), ""};
  if (unit_begin < end && unit_begin != std::string::npos)
    parts.unit = text.substr(unit_begin, end - unit_begin);
  // "1.2.3", "4e" and "1-2" are slips of the pen, not numbers with a unit.
  if (!parts.unit.empty() && unit_begin == number_end &&
      (parts.unit[0] == '.' || parts.unit[0] == '-' || parts.unit[0] == '+' || parts.unit == "e"))
    throw InputError("\"" + shown + "\" is not a number");
  return parts;
}

double to_si(const std::string& text, const std::string& si_unit) {
  const NumberWithUnit parts = split_unit(text);
  Unit unit;
  if (!parts.unit.empty()) {
    const auto accepted = [&] { return " Accepted: " + join(accepted_units(si_unit)) + "."; };
    try {
      unit = parse_unit(parts.unit);
    } catch (const InputError& error) {
      throw InputError(error.what() + accepted());
    }
    if (unit.dimension != parse_unit(si_unit).dimension)
      throw InputError("the unit \"" + parts.unit + "\" does not measure the same as " +
                       (si_unit == "1" ? "a pure number" : si_unit) + "." + accepted());
  }
  // The decimal exponent is shifted in the text: 0.3 mm becomes "0.3e-3", rounded once.
  std::size_t e = parts.number.find_first_of("eE");
  int exponent = unit.exponent;
  std::string mantissa = parts.number.substr(0, e);
  if (e != std::string::npos) exponent += std::stoi(parts.number.substr(e + 1));
  const std::string shifted = mantissa + "e" + std::to_string(exponent);
  double value = 0;
  const auto [stop, error] = std::from_chars(shifted.data(), shifted.data() + shifted.size(), value);
  if (error != std::errc() || stop != shifted.data() + shifted.size() || !std::isfinite(value))
    throw InputError("\"" + text + "\" is too large or too small");
  return value * unit.factor + unit.offset;
}

std::vector<std::string> accepted_units(const std::string& si_unit) {
  const auto dimension = parse_unit(si_unit).dimension;
  std::vector<std::string> names{si_unit};
  for (const std::string& name : common_units())
    if (name != si_unit && parse_unit(name).dimension == dimension) names.push_back(name);
  return names;
}

std::string exact_text(double value) {
  char buffer[64];
  const auto [end, error] = std::to_chars(buffer, buffer + sizeof buffer, value);
  return error == std::errc() ? std::string(buffer, end) : "nan";
}

}  // namespace seedflow
