#pragma once

#include <string>
#include <vector>

namespace seedflow {

/// One `set` line of a .prm file (or one --set override) and where it stands.
struct ParameterLine {
  std::string where;                  ///< "prm/x.prm:12" or "--set \"Seeds/Diameter=1\""
  std::vector<std::string> sections;  ///< enclosing sections, outermost first
  std::string name;
  std::string value;
  bool section_only = false;  ///< a `subsection` line, kept so that a misspelt empty section is noticed
};

/// The lines of a file in the format of dealii::ParameterHandler (subsection, end, set, include, '#', a
/// backslash that continues a line), with file and line number of each, included files (relative to the
/// including one) in place. ParameterHandler itself keeps no line numbers once it has parsed. Throws
/// InputError listing every malformed line: missing file, missing `end`, `set` without '=', unknown
/// statement, a file that includes itself.
std::vector<ParameterLine> scan_parameter_file(const std::string& file);

/// Reads "Section/Subsection/Entry=value".
ParameterLine scan_override(const std::string& text);

/// The line that sets `path` ("Section/Entry") in the file or, with precedence, the overrides; without a name
/// if none does. For the entries that decide what else is declared.
ParameterLine find_parameter_line(const std::string& file, const std::vector<std::string>& overrides,
                                  const std::string& path);

/// "Section/Sub/Entry" of a line.
std::string path_of(const ParameterLine& line);

}  // namespace seedflow
