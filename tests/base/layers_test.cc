#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>

#include "places.h"

namespace {

namespace fs = std::filesystem;
using Names = std::set<std::string>;

/// What each folder may include besides itself.
const std::map<std::string, Names> allowed = {
    {"base", {}},
    {"mesh", {"base"}},
    {"effects", {"base"}},
    {"fluid", {"base", "mesh", "effects"}},
    {"seeds", {"base", "effects"}},
    {"coupling", {"base", "mesh", "effects", "fluid", "seeds"}},
    {"output", {"base", "mesh", "effects", "fluid", "seeds", "coupling"}},
    {"experiment", {"base", "mesh", "effects", "fluid", "seeds", "coupling", "output"}},
    {"truth", {"base"}},
    {"diagnose", {"base", "mesh", "effects", "fluid", "seeds", "coupling", "output", "experiment", "truth"}},
};
/// These compute with plain numbers and vectors alone.
const Names without_dealii = {"effects", "seeds"};

/// What is wrong with one include line of a file of `layer`; "" if nothing.
std::string complaint(const std::string& layer, const std::string& line) {
  static const std::regex own("^\\s*#\\s*include\\s*[<\"]seedflow/([a-z_]+)/.*");
  static const std::regex library("^\\s*#\\s*include\\s*[<\"]deal\\.II/.*");
  std::smatch match;
  if (std::regex_match(line, match, own)) {
    const std::string other = match[1];
    if (allowed.count(other) == 0) return "includes the unknown layer " + other;
    if (other != layer && allowed.at(layer).count(other) == 0) return "must not include " + other;
  }
  if (without_dealii.count(layer) > 0 && std::regex_match(line, library)) return "must not include deal.II";
  return "";
}

TEST(Layers, TheRuleItselfIsChecked) {
  EXPECT_EQ(complaint("fluid", "#include \"seedflow/mesh/point_location.h\""), "");
  EXPECT_EQ(complaint("fluid", "#include \"seedflow/fluid/exchange.h\""), "");
  EXPECT_EQ(complaint("fluid", "#include \"seedflow/seeds/seed_template.h\""), "must not include seeds");
  EXPECT_EQ(complaint("seeds", "# include <seedflow/mesh/domain.h>"), "must not include mesh");
  EXPECT_EQ(complaint("seeds", "#include <deal.II/base/point.h>"), "must not include deal.II");
  EXPECT_EQ(complaint("base", "#include \"seedflow/sandbox/a.h\""), "includes the unknown layer sandbox");
}

TEST(Layers, EachIncludesOnlyWhatStandsToItsLeft) {
  int files = 0;
  for (const char* top : {"include/seedflow", "source"}) {
    const fs::path root = fs::path(seedflow::places::source_dir) / top;
    for (const auto& item : fs::recursive_directory_iterator(root)) {
      const std::string extension = item.path().extension();
      if (!item.is_regular_file() || (extension != ".h" && extension != ".cc")) continue;
      const fs::path relative = fs::relative(item.path(), root);
      if (relative.begin() == std::prev(relative.end())) continue;  // main.cc sees everything
      const std::string layer = relative.begin()->string();
      ASSERT_EQ(allowed.count(layer), 1u) << "unknown layer: " << item.path();
      ++files;
      std::ifstream in(item.path());
      std::string line;
      for (int number = 1; std::getline(in, line); ++number) {
        const std::string wrong = complaint(layer, line);
        EXPECT_EQ(wrong, "") << item.path().string() << ":" << number << ": " << layer << " " << wrong;
      }
    }
  }
  EXPECT_GT(files, 10);
}

// ParameterHandler is an implementation detail of base/parameters.cc; its header costs seconds in every file.
TEST(Layers, ParameterHandlerStaysOutOfHeaders) {
  for (const auto& item :
       fs::recursive_directory_iterator(fs::path(seedflow::places::source_dir) / "include")) {
    if (!item.is_regular_file()) continue;
    std::ifstream in(item.path());
    const std::string text((std::istreambuf_iterator<char>(in)), {});
    EXPECT_EQ(text.find("#include <deal.II/base/parameter_handler.h>"), std::string::npos) << item.path();
  }
}

}  // namespace
