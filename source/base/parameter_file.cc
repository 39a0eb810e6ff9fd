#include "seedflow/base/parameter_file.h"

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "seedflow/base/error.h"
#include "seedflow/base/trim.h"

namespace seedflow {
namespace {

/// Whether the line is the statement `keyword` (all small or all capital, as in deal.II); `rest` is what
/// follows.
bool statement(const std::string& line, const std::string& keyword, std::string& rest) {
  std::string capital = keyword;
  for (char& c : capital) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  for (const std::string& word : {keyword, capital})
    if (line.compare(0, word.size(), word) == 0 && (line.size() == word.size() || line[word.size()] == ' ')) {
      rest = trim(line.substr(word.size()));
      return true;
    }
  return false;
}

class Scanner {
 public:
  std::vector<ParameterLine> lines;
  std::vector<std::string> problems;

  void scan(const std::string& file) {
    std::ifstream in(file);
    if (std::filesystem::is_directory(file)) {
      problems.push_back(file + ": this is a folder; name a .prm file in it.");
      return;
    }
    if (!in) {
      problems.push_back(file + ": this file cannot be opened. Check its name and that it can be read.");
      return;
    }
    open_files.push_back(file);
    const std::size_t outer_depth = depth_of_file;
    depth_of_file = sections.size();
    std::string text, logical;
    int number = 0, begin_line = 0;
    bool continued = false;
    while (std::getline(in, text)) {
      ++number;
      if (!continued) {
        logical.clear();
        begin_line = number;
      }
      text = text.substr(0, text.find('#'));
      std::replace(text.begin(), text.end(), '\t', ' ');
      text = trim(text);
      continued = !text.empty() && text.back() == '\\';
      if (continued) text.pop_back();
      logical += text;
      if (!continued) line(trim(logical), file + ":" + std::to_string(begin_line));
    }
    if (continued)
      problems.push_back(file + ":" + std::to_string(number) +
                         ": the file ends inside a continued line ('\\').");
    while (sections.size() > depth_of_file) {
      problems.push_back(opened.back() + ": section \"" + sections.back() +
                         "\" is not closed: a line `end` is missing.");
      sections.pop_back();
      opened.pop_back();
    }
    depth_of_file = outer_depth;
    open_files.pop_back();
  }

 private:
  std::vector<std::string> sections, opened, open_files;
  std::size_t depth_of_file = 0;  ///< sections open where the present file was included

  void line(const std::string& text, const std::string& where) {
    std::string rest;
    if (text.empty()) return;
    if (statement(text, "subsection", rest)) {
      if (rest.empty()) problems.push_back(where + ": `subsection` without a name.");
      sections.push_back(rest);
      opened.push_back(where);
      lines.push_back({where, sections, "", "", true});
    } else if (statement(text, "end", rest)) {
      if (!rest.empty())
        problems.push_back(where + ": \"" + rest + "\" after `end`; `end` stands alone on its line.");
      if (sections.size() == depth_of_file)
        problems.push_back(where + ": `end` without a `subsection` that it could close.");
      else {
        sections.pop_back();
        opened.pop_back();
      }
    } else if (statement(text, "set", rest)) {
      const std::size_t equals = rest.find('=');
      if (equals == std::string::npos || trim(rest.substr(0, equals)).empty())
        problems.push_back(where + ": \"" + text + "\" has no name or no '='; write `set Name = value`.");
      else
        lines.push_back(
            {where, sections, trim(rest.substr(0, equals)), trim(rest.substr(equals + 1)), false});
    } else if (statement(text, "include", rest)) {
      include(rest, where);
    } else {
      problems.push_back(where + ": \"" + text +
                         "\" is not a statement; lines begin with set, subsection, end, include or '#'.");
    }
  }

  void include(const std::string& name, const std::string& where) {
    const std::filesystem::path path(name);
    const std::string file =
        path.is_absolute() ? name : (std::filesystem::path(open_files.back()).parent_path() / path).string();
    for (const std::string& open : open_files) {
      std::error_code ignored;  // a file that does not exist is reported by scan()
      if (std::filesystem::equivalent(open, file, ignored)) {
        problems.push_back(where + ": \"" + name + "\" includes itself.");
        return;
      }
    }
    if (!std::filesystem::exists(file))
      problems.push_back(where + ": the included file \"" + file + "\" does not exist.");
    else
      scan(file);
  }
};

}  // namespace

std::vector<ParameterLine> scan_parameter_file(const std::string& file) {
  Scanner scanner;
  scanner.scan(file);
  if (!scanner.problems.empty()) {
    std::string text;
    for (const std::string& problem : scanner.problems) text += (text.empty() ? "" : "\n") + problem;
    throw InputError(text);
  }
  return std::move(scanner.lines);
}

ParameterLine scan_override(const std::string& text) {
  const std::string where = "--set \"" + text + "\"";
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || trim(text.substr(0, equals)).empty())
    throw InputError(where + ": has no name or no '='; write --set \"Section/Entry=value\".");
  ParameterLine line{where, {}, "", trim(text.substr(equals + 1)), false};
  const std::string path = text.substr(0, equals);
  std::size_t begin = 0;
  for (std::size_t slash; (slash = path.find('/', begin)) != std::string::npos; begin = slash + 1)
    line.sections.push_back(trim(path.substr(begin, slash - begin)));
  line.name = trim(path.substr(begin));
  return line;
}

std::string path_of(const ParameterLine& line) {
  std::string path;
  for (const std::string& section : line.sections) path += section + "/";
  return path + line.name;
}

ParameterLine find_parameter_line(const std::string& file, const std::vector<std::string>& overrides,
                                  const std::string& path) {
  ParameterLine found;
  for (const ParameterLine& line : scan_parameter_file(file))
    if (!line.section_only && path_of(line) == path) found = line;
  for (const std::string& text : overrides)
    if (const ParameterLine line = scan_override(text); path_of(line) == path) found = line;
  return found;
}

}  // namespace seedflow
