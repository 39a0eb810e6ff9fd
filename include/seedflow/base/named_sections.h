#pragma once

#include <string>
#include <vector>

namespace seedflow {

/// Lists of named subsections in a .prm: which subsections are to be declared depends on a list of names in
/// the file itself, and which entries they have may depend on a kind given there. These are read first, from
/// the file and the overrides, before the entries are declared for Parameters::read.

/// The names that the entry `path` ("Walls/Names") lists, or none. `what` ("wall") is for messages.
/// Errors: InputError with file and line for an empty, repeated or unusable name.
std::vector<std::string> listed_names(const std::string& file, const std::vector<std::string>& overrides,
                                      const std::string& path, const std::string& what);

/// The value of an entry as written, or `otherwise` if nothing sets it.
std::string written_value(const std::string& file, const std::vector<std::string>& overrides,
                          const std::string& path, const std::string& otherwise);

}  // namespace seedflow
