#pragma once

#include <string>

namespace seedflow {

/// Without blanks at both ends.
inline std::string trim(const std::string& s) {
  const auto a = s.find_first_not_of(" \t"), b = s.find_last_not_of(" \t");
  return a == std::string::npos ? "" : s.substr(a, b - a + 1);
}

}  // namespace seedflow
