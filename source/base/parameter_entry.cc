#include "parameter_entry.h"

#include <algorithm>
#include <charconv>

#include "seedflow/base/nearest_name.h"
#include "seedflow/base/units.h"

namespace seedflow {

std::string trimmed(const std::string& text) {
  const std::size_t begin = text.find_first_not_of(" \t");
  if (begin == std::string::npos) return "";
  return text.substr(begin, text.find_last_not_of(" \t") - begin + 1);
}

std::vector<std::string> split_list(const std::string& text) {
  std::vector<std::string> parts;
  if (trimmed(text).empty()) return parts;
  std::size_t begin = 0;
  for (std::size_t comma; (comma = text.find(',', begin)) != std::string::npos; begin = comma + 1)
    parts.push_back(trimmed(text.substr(begin, comma - begin)));
  parts.push_back(trimmed(text.substr(begin)));
  return parts;
}

std::string join(const std::vector<std::string>& names, const std::string& separator) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : separator) + name;
  return text;
}

std::string in_words(const Range& range) {
  const bool low = std::isfinite(range.low), high = std::isfinite(range.high);
  std::string text;
  if (low) text += (range.low_open ? "greater than " : "at least ") + exact_text(range.low);
  if (low && high) text += " and ";
  if (high) text += "at most " + exact_text(range.high);
  return text;
}

static void check_bounds(double value, const std::string& unit, const Range& range) {
  if (value > range.low && value <= range.high) return;
  if (value == range.low && !range.low_open) return;
  const std::string shown = unit == "1" ? "" : " " + unit;
  throw InputError(exact_text(value) + shown + " is out of bounds. Allowed: " + in_words(range) + shown);
}

double read_number(const std::string& text, const std::string& unit, const Range& range) {
  const double value = to_si(text, unit);
  check_bounds(value, unit, range);
  return value;
}

std::vector<double> read_numbers(const std::string& text, const std::string& unit, const Range& range) {
  std::vector<std::string> parts = split_list(text);
  std::size_t with_unit = 0;
  for (const std::string& part : parts) with_unit += split_unit(part).unit.empty() ? 0 : 1;
  if (with_unit > 0 && with_unit < parts.size()) {
    const std::string common = split_unit(parts.back()).unit;
    if (with_unit > 1 || common.empty())
      throw InputError(
          "some of the numbers have a unit and others have none. Give one unit after the last number, "
          "for all of them, or one after each");
    for (std::size_t i = 0; i + 1 < parts.size(); ++i) parts[i] += " " + common;
  }
  std::vector<double> values;
  for (const std::string& part : parts) values.push_back(read_number(part, unit, range));
  return values;
}

int read_integer(const std::string& text, const Range& range) {
  const std::string number = trimmed(text);
  const char* begin = number.data() + (!number.empty() && number[0] == '+' ? 1 : 0);
  const char* end = number.data() + number.size();
  int value = 0;
  const auto [stop, error] = std::from_chars(begin, end, value);
  if (error == std::errc::result_out_of_range) throw InputError("\"" + number + "\" is too large");
  if (error != std::errc() || stop != end) throw InputError("\"" + number + "\" is not an integer");
  check_bounds(value, "1", range);
  return value;
}

bool read_flag(const std::string& text) {
  const std::string word = trimmed(text);
  for (const char* yes : {"true", "yes", "on"})
    if (word == yes) return true;
  for (const char* no : {"false", "no", "off"})
    if (word == no) return false;
  throw InputError("\"" + word + "\" is neither true nor false");
}

std::string read_choice(const std::string& text, const std::vector<std::string>& options) {
  const std::string word = trimmed(text);
  if (std::find(options.begin(), options.end(), word) != options.end()) return word;
  throw InputError("\"" + word + "\" is not one of its values. " + suggestion(word, options, "value"));
}

std::string read_text(const std::string& text) {
  const std::string value = trimmed(text);
  if (value.find_first_of("#\n\r") != std::string::npos || (!value.empty() && value.back() == '\\'))
    throw InputError("'#', a line break and a final '\\' cannot stand in a value of a .prm file");
  return value;
}

std::string exact_text(const std::vector<double>& values) {
  std::vector<std::string> texts;
  for (const double value : values) texts.push_back(exact_text(value));
  return join(texts);
}

}  // namespace seedflow
