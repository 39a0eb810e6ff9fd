#pragma once

#include <string>
#include <vector>

namespace seedflow {

/// The candidate with the fewest insertions, deletions and replacements to `name`, upper and lower case
/// alike.
std::string nearest_name(const std::string& name, const std::vector<std::string>& candidates);

}  // namespace seedflow
