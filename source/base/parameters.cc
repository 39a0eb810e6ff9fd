#include "seedflow/base/parameters.h"

#include <deal.II/base/parameter_handler.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <map>
#include <ostream>
#include <sstream>

#include "parameter_entry.h"
#include "seedflow/base/nearest_name.h"
#include "seedflow/base/parameter_file.h"
#include "seedflow/base/units.h"

namespace seedflow {
namespace {

namespace fs = std::filesystem;

/// Lets ParameterHandler accept exactly what the entry's own reader accepts.
class EntryPattern : public dealii::Patterns::PatternBase {
 public:
  explicit EntryPattern(const ParameterEntry& e) : normalise(e.normalise), allowed(e.allowed) {}
  bool match(const std::string& text) const override {
    try {
      normalise(text);
      return true;
    } catch (const InputError&) {
      return false;
    }
  }
  std::string description(const OutputStyle) const override { return allowed; }
  std::unique_ptr<PatternBase> clone() const override { return std::make_unique<EntryPattern>(*this); }

 private:
  std::function<std::string(const std::string&)> normalise;
  std::string allowed;
};

struct SectionNode {
  std::string name, doc;
  SectionNode* parent = nullptr;
  std::vector<ParameterEntry> entries;
  std::vector<std::unique_ptr<SectionNode>> sections;

  SectionNode* find_section(const std::string& wanted) const {
    for (const auto& section : sections)
      if (section->name == wanted) return section.get();
    return nullptr;
  }
  const ParameterEntry* find_entry(const std::string& wanted) const {
    for (const ParameterEntry& entry : entries)
      if (entry.name == wanted) return &entry;
    return nullptr;
  }
  std::vector<std::string> path() const {
    std::vector<std::string> names;
    for (const SectionNode* node = this; node->parent; node = node->parent) names.push_back(node->name);
    std::reverse(names.begin(), names.end());
    return names;
  }
  std::string path_of_entry(const std::string& entry) const {
    std::string text;
    for (const std::string& section : path()) text += section + "/";
    return text + entry;
  }
};

/// Calls f(section, entry) for every entry, in the order of the written file.
template <typename F>
void for_each_entry(const SectionNode& node, const F& f) {
  for (const ParameterEntry& entry : node.entries) f(node, entry);
  for (const auto& section : node.sections) for_each_entry(*section, f);
}

std::vector<std::string> entry_names(const SectionNode& node) {
  std::vector<std::string> names;
  for (const ParameterEntry& entry : node.entries) names.push_back(entry.name);
  return names;
}

std::vector<std::string> section_names(const SectionNode& node) {
  std::vector<std::string> names;
  for (const auto& section : node.sections) names.push_back(section->name);
  return names;
}

/// `x.prm:12: section "Seeds/Material": entry "Density"`
std::string location(const std::string& where, const std::vector<std::string>& sections,
                     const std::string& entry) {
  std::string text = where.empty() ? "" : where + ": ";
  if (!sections.empty()) text += "section \"" + join(sections, "/") + "\"" + (entry.empty() ? "" : ": ");
  if (!entry.empty()) text += "entry \"" + entry + "\"";
  return text;
}

std::string file_of(const std::string& where) {
  return where.substr(0, where.rfind(':'));
}

void write_comment(std::ostream& out, const std::string& indent, const std::string& text) {
  std::istringstream words(text);
  std::string word, line;
  const auto flush = [&] {
    if (!line.empty()) out << indent << '#' << line << '\n';
    line.clear();
  };
  while (words >> word) {
    if (indent.size() + line.size() + word.size() > 98) flush();
    line += " " + word;
  }
  flush();
}

}  // namespace

struct Parameters::Implementation {
  dealii::ParameterHandler handler;
  SectionNode root;
  SectionNode* current = &root;
  std::string file;
  std::map<std::string, ParameterLine> lines;  ///< what set an entry, by path

  void declare(ParameterEntry entry);
  std::pair<const SectionNode*, const ParameterEntry*> find(const std::string& path) const;
  std::pair<const SectionNode*, const ParameterEntry*> find_or_throw(const std::string& path) const;
  std::string value(const SectionNode& node, const std::string& entry) const {
    return handler.get(node.path(), entry);
  }
  void set(const SectionNode& node, const std::string& entry, const std::string& text);
  void accept(ParameterLine line, bool is_override, std::vector<std::string>& problems);
  const SectionNode* section_of(const ParameterLine& line, std::vector<std::string>& problems,
                                std::vector<std::string>& unknown_sections) const;
  void write_section(std::ostream& out, const SectionNode& node, int depth) const;
  void describe_section(std::ostream& out, const SectionNode& node) const;
};

void Parameters::Implementation::declare(ParameterEntry entry) {
  const std::string path = current->path_of_entry(entry.name);
  if (entry.name.empty() || entry.name.find_first_of("/=#{}") != std::string::npos)
    throw std::logic_error("parameter name \"" + path + "\" contains one of / = # { } or is empty");
  if (current->find_entry(entry.name)) throw std::logic_error("parameter \"" + path + "\" is declared twice");
  if (!entry.unit.empty()) {
    const Unit unit = parse_unit(entry.unit);
    if (unit.factor != 1 || unit.exponent != 0 || unit.offset != 0)
      throw std::logic_error("parameter \"" + path + "\": unit \"" + entry.unit + "\" is not an SI unit");
  }
  try {
    entry.normalise(entry.initial);
  } catch (const InputError& error) {
    throw std::logic_error("parameter \"" + path + "\": its default is not allowed: " + error.what());
  }
  for (const std::string& section : current->path()) handler.enter_subsection(section);
  handler.declare_entry(entry.name, entry.initial, EntryPattern(entry), entry.doc);
  for (std::size_t i = 0; i < current->path().size(); ++i) handler.leave_subsection();
  current->entries.push_back(std::move(entry));
}

void Parameters::Implementation::set(const SectionNode& node, const std::string& entry,
                                     const std::string& text) {
  const std::vector<std::string> path = node.path();
  for (const std::string& section : path) handler.enter_subsection(section);
  handler.set(entry, text);
  for (std::size_t i = 0; i < path.size(); ++i) handler.leave_subsection();
}

std::pair<const SectionNode*, const ParameterEntry*> Parameters::Implementation::find(
    const std::string& path) const {
  const SectionNode* node = &root;
  std::size_t begin = 0;
  for (std::size_t slash; node && (slash = path.find('/', begin)) != std::string::npos; begin = slash + 1)
    node = node->find_section(path.substr(begin, slash - begin));
  return {node, node ? node->find_entry(path.substr(begin)) : nullptr};
}

std::pair<const SectionNode*, const ParameterEntry*> Parameters::Implementation::find_or_throw(
    const std::string& path) const {
  const auto found = find(path);
  if (found.second) return found;
  std::vector<std::string> paths;
  for_each_entry(root, [&](const SectionNode& node, const ParameterEntry& entry) {
    paths.push_back(node.path_of_entry(entry.name));
  });
  const std::string near = nearest_name(path, paths);
  throw InputError("entry \"" + path + "\" is not known." +
                   (near.empty() ? "" : " Nearest valid entry: \"" + near + "\"."));
}

const SectionNode* Parameters::Implementation::section_of(const ParameterLine& line,
                                                          std::vector<std::string>& problems,
                                                          std::vector<std::string>& unknown_sections) const {
  const SectionNode* node = &root;
  std::vector<std::string> outer;
  for (const std::string& name : line.sections) {
    const SectionNode* next = node->find_section(name);
    if (!next) {
      const std::string key = join(outer, "/") + "/" + name;
      if (std::find(unknown_sections.begin(), unknown_sections.end(), key) == unknown_sections.end()) {
        unknown_sections.push_back(key);
        const std::string place = location(line.where, outer, "");
        problems.push_back(place + (outer.empty() ? "" : ": ") + "section \"" + name + "\" is not known. " +
                           suggestion(name, section_names(*node), "section"));
      }
      return nullptr;
    }
    outer.push_back(name);
    node = next;
  }
  return node;
}

void Parameters::Implementation::accept(ParameterLine line, bool is_override,
                                        std::vector<std::string>& problems) {
  const std::string path = path_of(line);
  const auto [node, entry] = find(path);
  const std::string place = location(line.where, line.sections, line.name);
  if (!entry) {
    std::string text = place + " is not known. ";
    std::string elsewhere;
    for_each_entry(root, [&](const SectionNode& section, const ParameterEntry& other) {
      if (other.name == line.name) elsewhere = section.path_of_entry(other.name);
    });
    if (nearest_name(line.name, entry_names(*node)).empty() && !elsewhere.empty())
      text += "There is an entry of that name at \"" + elsewhere + "\".";
    else
      text += suggestion(line.name, entry_names(*node), "entry");
    problems.push_back(text);
    return;
  }
  if (const auto before = lines.find(path); before != lines.end()) {
    const bool before_is_override = before->second.where.compare(0, 5, "--set") == 0;
    if (before_is_override == is_override &&
        (is_override || file_of(before->second.where) == file_of(line.where))) {
      problems.push_back(place + " is set twice, first at " + before->second.where + " (\"" +
                         before->second.value + "\"). Remove one of them.");
      return;
    }
  }
  try {
    std::string value = line.value;
    if (entry->is_file && !value.empty())
      value =
          fs::absolute(is_override ? fs::path(value) : fs::path(file_of(line.where)).parent_path() / value)
              .lexically_normal()
              .string();
    set(*node, entry->name, entry->normalise(value));
    lines[path] = line;
  } catch (const InputError& error) {
    std::string reason = error.what();
    if (reason.back() != '.') reason += ".";
    if (reason.find("out of bounds") == std::string::npos) reason += " Expected: " + entry->allowed + ".";
    problems.push_back(place + " = \"" + line.value + "\": " + reason);
  }
}

Parameters::Parameters() : implementation(std::make_unique<Implementation>()) {}
Parameters::~Parameters() = default;
Parameters::Parameters(Parameters&&) noexcept = default;
Parameters& Parameters::operator=(Parameters&&) noexcept = default;

void Parameters::enter(const std::string& name, const std::string& doc) {
  SectionNode*& current = implementation->current;
  SectionNode* node = current->find_section(name);
  if (!node) {
    if (name.empty() || name.find_first_of("/=#") != std::string::npos)
      throw std::logic_error("section name \"" + name + "\" contains one of / = # or is empty");
    current->sections.push_back(std::make_unique<SectionNode>());
    node = current->sections.back().get();
    node->name = name;
    node->parent = current;
  }
  if (node->doc.empty()) node->doc = doc;
  current = node;
}

void Parameters::leave() {
  implementation->current = implementation->current->parent;
}

namespace {
std::string with_bounds(const std::string& kind, const std::string& unit, const Range& range) {
  std::string text = kind;
  if (!unit.empty() && unit != "1") text += " in " + unit;
  const std::string bounds = in_words(range);
  return bounds.empty() ? text : text + ", " + bounds;
}
}  // namespace

void Parameters::number(const std::string& name, double& target, const std::string& unit, Range range,
                        const std::string& doc) {
  ParameterEntry entry{name,  unit, doc, with_bounds("a number", unit, range), exact_text(target),
                       false, {},   {}};
  entry.normalise = [=](const std::string& text) { return exact_text(read_number(text, unit, range)); };
  entry.assign = [=, &target](const std::string& text) { target = read_number(text, unit, range); };
  implementation->declare(std::move(entry));
}

void Parameters::integer(const std::string& name, int& target, Range range, const std::string& doc) {
  ParameterEntry entry{name,  "", doc, with_bounds("an integer", "", range), std::to_string(target),
                       false, {}, {}};
  entry.normalise = [=](const std::string& text) { return std::to_string(read_integer(text, range)); };
  entry.assign = [=, &target](const std::string& text) { target = read_integer(text, range); };
  implementation->declare(std::move(entry));
}

void Parameters::flag(const std::string& name, bool& target, const std::string& doc) {
  ParameterEntry entry{name, "", doc, "true or false", target ? "true" : "false", false, {}, {}};
  entry.normalise = [](const std::string& text) { return std::string(read_flag(text) ? "true" : "false"); };
  entry.assign = [&target](const std::string& text) { target = read_flag(text); };
  implementation->declare(std::move(entry));
}

void Parameters::choice(const std::string& name, std::string& target, const std::vector<std::string>& options,
                        const std::string& doc) {
  ParameterEntry entry{name, "", doc, "one of " + join(options), target, false, {}, {}};
  entry.normalise = [=](const std::string& text) { return read_choice(text, options); };
  entry.assign = [&target](const std::string& text) { target = text; };
  implementation->declare(std::move(entry));
}

void Parameters::text(const std::string& name, std::string& target, const std::string& doc) {
  ParameterEntry entry{name, "", doc, "text", target, false, read_text, {}};
  entry.assign = [&target](const std::string& text) { target = text; };
  implementation->declare(std::move(entry));
}

void Parameters::file(const std::string& name, std::string& target, const std::string& doc) {
  ParameterEntry entry{name, "", doc, "the name of a file, or nothing", target, true, read_text, {}};
  entry.assign = [&target](const std::string& text) { target = text; };
  implementation->declare(std::move(entry));
}

void Parameters::vector(const std::string& name, Vec3& target, const std::string& unit, Range range,
                        const std::string& doc) {
  const auto read = [=](const std::string& text) {
    const std::vector<double> v = read_numbers(text, unit, range);
    if (v.size() != 3) throw InputError(std::to_string(v.size()) + " numbers were given, three are needed");
    return v;
  };
  ParameterEntry entry{name,
                       unit,
                       doc,
                       with_bounds("three numbers x, y, z", unit, range),
                       exact_text(std::vector<double>{target.x, target.y, target.z}),
                       false,
                       {},
                       {}};
  entry.normalise = [=](const std::string& text) { return exact_text(read(text)); };
  entry.assign = [=, &target](const std::string& text) {
    const std::vector<double> v = read(text);
    target = {v[0], v[1], v[2]};
  };
  implementation->declare(std::move(entry));
}

void Parameters::numbers(const std::string& name, std::vector<double>& target, const std::string& unit,
                         Range range, const std::string& doc) {
  ParameterEntry entry{
      name,  unit, doc, with_bounds("numbers separated by commas", unit, range), exact_text(target),
      false, {},   {}};
  entry.normalise = [=](const std::string& text) { return exact_text(read_numbers(text, unit, range)); };
  entry.assign = [=, &target](const std::string& text) { target = read_numbers(text, unit, range); };
  implementation->declare(std::move(entry));
}

void Parameters::texts(const std::string& name, std::vector<std::string>& target, const std::string& doc) {
  ParameterEntry entry{name, "", doc, "texts separated by commas", join(target), false, {}, {}};
  entry.normalise = [](const std::string& text) { return join(split_list(read_text(text))); };
  entry.assign = [&target](const std::string& text) { target = split_list(text); };
  implementation->declare(std::move(entry));
}

void Parameters::choices(const std::string& name, std::vector<std::string>& target,
                         const std::vector<std::string>& options, const std::string& doc) {
  ParameterEntry entry{name,         "",    doc, "any of " + join(options) + ", separated by commas",
                       join(target), false, {},  {}};
  entry.normalise = [=](const std::string& text) {
    std::vector<std::string> members;
    for (const std::string& member : split_list(text)) members.push_back(read_choice(member, options));
    return join(members);
  };
  entry.assign = [&target](const std::string& text) { target = split_list(text); };
  implementation->declare(std::move(entry));
}

void Parameters::read(const std::string& file, const std::vector<std::string>& overrides) {
  Implementation& p = *implementation;
  p.file = file;
  p.lines.clear();
  for_each_entry(p.root,
                 [&](const SectionNode& node, const ParameterEntry& e) { p.set(node, e.name, e.initial); });

  std::vector<std::string> problems, unknown_sections;
  const auto take = [&](const ParameterLine& line, bool is_override) {
    if (p.section_of(line, problems, unknown_sections) && !line.section_only)
      p.accept(line, is_override, problems);
  };
  for (const ParameterLine& line : scan_parameter_file(file)) take(line, false);
  for (const std::string& text : overrides) {
    unknown_sections.clear();
    take(scan_override(text), true);
  }
  if (!problems.empty()) throw InputError(join(problems, "\n"));

  for_each_entry(p.root,
                 [&](const SectionNode& node, const ParameterEntry& e) { e.assign(p.value(node, e.name)); });
}

void Parameters::Implementation::write_section(std::ostream& out, const SectionNode& node, int depth) const {
  const std::string indent(2 * static_cast<std::size_t>(depth), ' ');
  for (const ParameterEntry& entry : node.entries) {
    write_comment(out, indent, entry.doc);
    const std::string origin =
        entry.initial == value(node, entry.name) ? "" : " Default: " + entry.initial + ".";
    write_comment(out, indent, "(" + entry.allowed + ".)" + origin);
    out << indent << "set " << entry.name << " = " << value(node, entry.name) << "\n\n";
  }
  for (const auto& section : node.sections) {
    write_comment(out, indent, section->doc);
    out << indent << "subsection " << section->name << '\n';
    write_section(out, *section, depth + 1);
    out << indent << "end\n\n";
  }
}

void Parameters::write(std::ostream& out) const {
  implementation->write_section(out, implementation->root, 0);
}

void Parameters::Implementation::describe_section(std::ostream& out, const SectionNode& node) const {
  const std::string path = join(node.path(), "/");
  if (!path.empty() && (!node.entries.empty() || !node.doc.empty())) {
    out << path << '\n';
    if (!node.doc.empty()) write_comment(out, "  ", node.doc);
  }
  for (const ParameterEntry& entry : node.entries) {
    out << "  " << entry.name << " = " << entry.initial;
    if (!entry.unit.empty() && entry.unit != "1") out << " [" << entry.unit << "]";
    out << "\n";
    write_comment(out, "      ", entry.doc);
    write_comment(out, "      ", "(" + entry.allowed + ".)");
  }
  if (!node.entries.empty()) out << '\n';
  for (const auto& section : node.sections) describe_section(out, *section);
}

void Parameters::describe(std::ostream& out, const std::string& section) const {
  const SectionNode* node = &implementation->root;
  std::size_t begin = 0;
  while (node && !section.empty() && begin <= section.size()) {
    const std::size_t slash = std::min(section.find('/', begin), section.size());
    const std::string name = section.substr(begin, slash - begin);
    const SectionNode* next = node->find_section(name);
    if (!next)
      throw InputError("section \"" + section + "\" is not known. " +
                       suggestion(name, section_names(*node), "section"));
    node = next;
    begin = slash + 1;
  }
  implementation->describe_section(out, *node);
}

void Parameters::reject(const std::string& path, const std::string& reason, const std::string& remedy) const {
  const auto [node, entry] = implementation->find_or_throw(path);
  const auto line = implementation->lines.find(path);
  std::string text;
  if (line != implementation->lines.end())
    text = location(line->second.where, node->path(), entry->name) + " = \"" + line->second.value + "\"";
  else
    text = location(implementation->file, node->path(), entry->name) + " (default " +
           implementation->value(*node, entry->name) +
           (entry->unit.empty() || entry->unit == "1" ? "" : " " + entry->unit) + ")";
  const auto sentence = [](std::string words) {
    if (!words.empty() && std::string(".!?").find(words.back()) == std::string::npos) words += ".";
    return words;
  };
  std::string what_to_do = sentence(remedy);
  if (!what_to_do.empty()) what_to_do[0] = static_cast<char>(std::toupper(what_to_do[0]));
  throw InputError(text + ": " + sentence(reason) + " " + what_to_do);
}

bool Parameters::is_set(const std::string& path) const {
  implementation->find_or_throw(path);
  return implementation->lines.count(path) > 0;
}

std::string Parameters::value(const std::string& path) const {
  const auto [node, entry] = implementation->find_or_throw(path);
  return implementation->value(*node, entry->name);
}

std::string Parameters::unit(const std::string& path) const {
  return implementation->find_or_throw(path).second->unit;
}

std::string Parameters::resolve(const std::string& file_name) const {
  const fs::path path(file_name);
  if (path.is_absolute()) return file_name;
  return (fs::path(implementation->file).parent_path() / path).lexically_normal().string();
}

}  // namespace seedflow
