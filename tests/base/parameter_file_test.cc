#include "seedflow/base/parameter_file.h"

#include <deal.II/base/parameter_handler.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "seedflow/base/error.h"

namespace seedflow {
namespace {

namespace fs = std::filesystem;

class ParameterFileTest : public testing::Test {
 protected:
  fs::path folder = fs::temp_directory_path() / ("seedflow_parameter_file_" + std::to_string(::getpid()));
  void SetUp() override { fs::create_directories(folder); }
  void TearDown() override { fs::remove_all(folder); }

  std::string write(const std::string& text, const std::string& name = "x.prm") {
    std::ofstream(folder / name) << text;
    return (folder / name).string();
  }
  std::string message(const std::string& file) {
    try {
      scan_parameter_file(file);
    } catch (const InputError& error) {
      std::string found = error.what();
      const std::string prefix = folder.string() + "/";
      for (std::size_t at; (at = found.find(prefix)) != std::string::npos;) found.erase(at, prefix.size());
      return found;
    }
    return "no error";
  }
};

TEST_F(ParameterFileTest, LinesKnowWhereTheyStand) {
  const std::string file = write(
      "# comment\nset A = 1 # why\n\nsubsection S\r\n\tset B = x \\\n  y\n  subsection T\n set C=\n "
      "end\nEND\nset D = "
      "a = b\n");
  const auto lines = scan_parameter_file(file);
  std::vector<std::string> found;
  for (const auto& line : lines)
    found.push_back(line.where.substr(file.size()) + " " + path_of(line) + "=" + line.value);
  EXPECT_EQ(found, (std::vector<std::string>{":2 A=1", ":4 S/=", ":5 S/B=x y",
                                             ":7 S/T/=", ":8 S/T/C=", ":11 D=a = b"}));
}

// The format stays deal.II's own: what the scanner reads is what ParameterHandler reads from the same text.
TEST_F(ParameterFileTest, AgreesWithParameterHandler) {
  const std::string text =
      "set A = 1 # why\nsubsection S\n  set B = x \\\n      y\n  SUBSECTION T U\n    SET C   =  3 mm, 4\n  "
      "END\n "
      "end\nsubsection S\n\tset E = = ;\nend\n";
  dealii::ParameterHandler handler;
  handler.declare_entry("A", "");
  handler.enter_subsection("S");
  handler.declare_entry("B", "");
  handler.declare_entry("E", "");
  handler.enter_subsection("T U");
  handler.declare_entry("C", "");
  handler.leave_subsection();
  handler.leave_subsection();
  handler.parse_input_from_string(text);
  int compared = 0;
  for (const auto& line : scan_parameter_file(write(text)))
    if (!line.section_only) {
      EXPECT_EQ(line.value, handler.get(line.sections, line.name)) << path_of(line);
      ++compared;
    }
  EXPECT_EQ(compared, 4);
}

TEST_F(ParameterFileTest, MissingFile) {
  EXPECT_EQ(message((folder / "y.prm").string()),
            "y.prm: this file cannot be opened. Check its name and that it can be read.");
  EXPECT_NE(message(folder.string()).find("this is a folder"), std::string::npos);
}

TEST_F(ParameterFileTest, MissingEnd) {
  EXPECT_EQ(message(write("set A = 1\nsubsection S\n  subsection T\n  end\n")),
            "x.prm:2: section \"S\" is not closed: a line `end` is missing.");
}

TEST_F(ParameterFileTest, MalformedLines) {
  EXPECT_EQ(
      message(write("end\nset A\nsett B = 1\nsubsection\nend now\ninclude nowhere.prm\nset C = 1 \\\n")),
      "x.prm:1: `end` without a `subsection` that it could close.\n"
      "x.prm:2: \"set A\" has no name or no '='; write `set Name = value`.\n"
      "x.prm:3: \"sett B = 1\" is not a statement; lines begin with set, subsection, end, include or '#'.\n"
      "x.prm:4: `subsection` without a name.\n"
      "x.prm:5: \"now\" after `end`; `end` stands alone on its line.\n"
      "x.prm:6: the included file \"nowhere.prm\" does not exist.\n"
      "x.prm:7: the file ends inside a continued line ('\\').");
}

TEST_F(ParameterFileTest, IncludedFiles) {
  fs::create_directories(folder / "sub");
  write("subsection T\n set B = 2\nend\ninclude more.prm\n", "sub/base.prm");
  write("set C = 3\n", "sub/more.prm");
  const auto lines = scan_parameter_file(write("subsection S\ninclude sub/base.prm\nend\nset D = 4\n"));
  ASSERT_EQ(lines.size(), 5u);
  EXPECT_EQ(path_of(lines[2]), "S/T/B");
  EXPECT_EQ(lines[2].where, (folder / "sub/base.prm").string() + ":2");
  EXPECT_EQ(path_of(lines[3]), "S/C");
  EXPECT_EQ(lines[4].where, (folder / "x.prm").string() + ":4");

  EXPECT_EQ(message(write("include x.prm\n")), "x.prm:1: \"x.prm\" includes itself.");
  // A section must be closed in the file that opens it.
  write("end\n", "close.prm");
  EXPECT_EQ(message(write("subsection S\ninclude close.prm\nend\n")),
            "close.prm:1: `end` without a `subsection` that it could close.");
}

TEST_F(ParameterFileTest, OverridesGoBeforeTheFile) {
  const std::string file = write("set A = 1\nsubsection S\nset B = 2\nend\n");
  EXPECT_EQ(find_parameter_line(file, {}, "A").value, "1");
  EXPECT_EQ(find_parameter_line(file, {" S / B = 3"}, "S/B").value, "3");
  EXPECT_EQ(find_parameter_line(file, {"S/B=3"}, "S/B").where, "--set \"S/B=3\"");
  EXPECT_EQ(find_parameter_line(file, {}, "C").name, "");
  EXPECT_THROW(scan_override("A"), InputError);
  EXPECT_THROW(scan_override("=1"), InputError);
}

}  // namespace
}  // namespace seedflow
