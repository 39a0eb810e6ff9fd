#include "seedflow/base/named_sections.h"

#include <algorithm>

#include "parameter_entry.h"
#include "seedflow/base/error.h"
#include "seedflow/base/parameter_file.h"

namespace seedflow {

std::vector<std::string> listed_names(const std::string& file, const std::vector<std::string>& overrides,
                                      const std::string& path, const std::string& what) {
  const ParameterLine line = find_parameter_line(file, overrides, path);
  if (line.name.empty()) return {};
  const std::vector<std::string> names = split_list(line.value);
  for (const std::string& name : names) {
    const std::string place = line.where + ": entry \"" + path + "\": ";
    if (name.empty() || name.find_first_of("/=#{}") != std::string::npos)
      throw InputError(place + "\"" + name + "\" cannot be the name of a " + what +
                       ". Use words without / = # { }.");
    if (std::count(names.begin(), names.end(), name) > 1)
      throw InputError(place + "\"" + name + "\" stands there twice. Give every " + what +
                       " a name of its own.");
  }
  return names;
}

std::string written_value(const std::string& file, const std::vector<std::string>& overrides,
                          const std::string& path, const std::string& otherwise) {
  const ParameterLine line = find_parameter_line(file, overrides, path);
  return line.name.empty() ? otherwise : line.value;
}

}  // namespace seedflow
