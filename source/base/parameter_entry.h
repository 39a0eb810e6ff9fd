#pragma once

#include <functional>
#include <string>
#include <vector>

#include "seedflow/base/parameters.h"

namespace seedflow {

/// One declared entry: its documentation and the functions that read it. Internal to Parameters.
struct ParameterEntry {
  std::string name, unit, doc;
  std::string allowed;  ///< in words: "a number in m, greater than 0"
  std::string initial;  ///< the bound variable's value at declaration, in canonical text
  bool is_file = false;
  /// Checks what a user wrote and returns it in canonical text (SI, full precision).
  /// Throws InputError with the reason alone; Parameters adds where.
  std::function<std::string(const std::string&)> normalise;
  /// Stores canonical text in the bound variable.
  std::function<void(const std::string&)> assign;
};

std::string trimmed(const std::string& text);
/// Splits at commas and trims; "" gives an empty list.
std::vector<std::string> split_list(const std::string& text);
std::string join(const std::vector<std::string>& names, const std::string& separator = ", ");

/// "greater than 0", "at least 0 and at most 1"; "" for no bounds.
std::string in_words(const Range& range);

/// Reads a number with an optional unit and checks the bounds.
double read_number(const std::string& text, const std::string& unit, const Range& range);
/// Reads a comma-separated list; a unit after the last number alone is the unit of all.
std::vector<double> read_numbers(const std::string& text, const std::string& unit, const Range& range);
int read_integer(const std::string& text, const Range& range);
bool read_flag(const std::string& text);
std::string read_choice(const std::string& text, const std::vector<std::string>& options);
/// Free text, as long as it can stand in a .prm file.
std::string read_text(const std::string& text);

std::string exact_text(const std::vector<double>& values);

}  // namespace seedflow
