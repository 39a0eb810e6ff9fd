#pragma once

#include <string>
#include <vector>

namespace seedflow {

/// Number of insertions, deletions, replacements and swaps of neighbours that turn a into b (optimal string
/// alignment distance, Damerau 1964, doi:10.1145/363958.363994), case ignored.
int edit_distance(const std::string& a, const std::string& b);

/// The candidate nearest to `name`, or "" if none is near enough to be what was meant.
std::string nearest_name(const std::string& name, const std::vector<std::string>& candidates);

/// A sentence for an error message: `Nearest valid entry: "Diameter".`, or the valid names if none is near.
/// `kind` is what the names are in the singular ("entry", "section", "command").
std::string suggestion(const std::string& name, const std::vector<std::string>& candidates,
                       const std::string& kind);

}  // namespace seedflow
