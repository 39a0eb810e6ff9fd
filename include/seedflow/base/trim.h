#pragma once

#include <string>

namespace seedflow {

/// Without blanks, tabs and line ends at both ends.
inline std::string trim(const std::string& text) {
  constexpr const char* blank = " \t\r\n";
  const std::size_t begin = text.find_first_not_of(blank);
  return begin == std::string::npos ? "" : text.substr(begin, text.find_last_not_of(blank) - begin + 1);
}

}  // namespace seedflow
