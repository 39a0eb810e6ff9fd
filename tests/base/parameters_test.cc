#include "seedflow/base/parameters.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace seedflow {
namespace {

namespace fs = std::filesystem;

/// One entry of each kind, as a module would declare them.
struct Settings {
  double diameter = 0.004;
  double density = 1000;
  double viscosity = 1.8e-5;
  double speed = 1;
  double pressure = 0;
  double angle = 0.5;
  double fraction = 0.4;
  int number = 70;
  bool rotate = true;
  std::string law = "Schiller-Naumann";
  std::string title = "a seed";
  std::string shape;
  Vec3 gravity{0, 0, -9.81};
  std::vector<double> levels{0.1, 1.0 / 3.0};
  std::vector<std::string> series{"a", "b"};
  std::vector<std::string> effects;
  std::string experiment = "settling";

  void declare(Parameters& p) {
    p.choice("Experiment", experiment, {"settling", "tank"}, "What is run.");
    {
      const auto seeds = p.section("Seeds", "The seeds.");
      p.number("Diameter", diameter, "m", Range{0, 0.1, true}, "Of the equal-volume sphere.");
      p.number("Density", density, "kg/m3", Range::positive(), "Of the seed.");
      p.integer("Sub-spheres", number, Range::between(1, 1000), "In one seed.");
      p.flag("Rotate", rotate, "Whether seeds turn.");
      p.file("Shape", shape, "Closed STL surface.");
      const auto start = p.section("Start", "Where seeds begin.");
      p.number("Friction angle", angle, "rad", Range::between(0, 1.5707963267948966), "Of the heap.");
      p.number("Fraction", fraction, "1", Range::between(0, 1), "Of the volume.");
    }
    const auto air = p.section("Air", "The air.");
    p.number("Dynamic viscosity", viscosity, "Pa s", Range::positive(), "Of the air.");
    p.number("Disc speed", speed, "rad/s", Range::any(), "Of the disc.");
    p.number("Vacuum", pressure, "Pa", Range{-1e5, 0}, "Below ambient.");
    p.vector("Gravity", gravity, "m/s2", Range::any(), "Acceleration of gravity.");
    p.numbers("Levels", levels, "m", Range::non_negative(), "Heights of the planes.");
    p.text("Title", title, "Of the report.");
    p.texts("Series", series, "Names of the series.");
    p.choice("Drag law", law, {"Schiller-Naumann", "Di Felice", "Gidaspow"}, "Drag on a sphere.");
    p.choices("Effects", effects, {"drag", "lift", "buoyancy"}, "What acts.");
  }
};

class ParametersTest : public testing::Test {
 protected:
  fs::path folder = fs::temp_directory_path() / ("seedflow_parameters_" + std::to_string(::getpid()));
  Settings settings;
  Parameters parameters;

  void SetUp() override {
    fs::create_directories(folder / "sub");
    settings.declare(parameters);
  }
  void TearDown() override { fs::remove_all(folder); }

  std::string write(const std::string& text, const std::string& name = "x.prm") {
    std::ofstream(folder / name) << text;
    return (folder / name).string();
  }
  void read(const std::string& text, const std::vector<std::string>& overrides = {}) {
    parameters.read(write(text), overrides);
  }
  /// The message with the folder cut off, so that a whole line can be compared.
  std::string message(const std::string& text, const std::vector<std::string>& overrides = {}) {
    try {
      read(text, overrides);
    } catch (const InputError& error) {
      std::string found = error.what();
      const std::string prefix = folder.string() + "/";
      for (std::size_t at; (at = found.find(prefix)) != std::string::npos;) found.erase(at, prefix.size());
      return found;
    }
    return "no error";
  }
};

TEST_F(ParametersTest, DefaultsAreTheVariablesOwnValues) {
  read("");
  EXPECT_EQ(settings.diameter, 0.004);
  EXPECT_EQ(settings.levels, (std::vector<double>{0.1, 1.0 / 3.0}));
  EXPECT_EQ(settings.gravity.z, -9.81);
  EXPECT_FALSE(parameters.is_set("Seeds/Diameter"));
}

TEST_F(ParametersTest, EveryKindIsRead) {
  read(R"(
# a comment
set Experiment = tank
subsection Seeds   # another
  set Diameter = 3 mm
	set Sub-spheres = 109
  set Rotate = no
  subsection Start
    set Friction angle = 30 deg
    set Fraction = 62 %
  end
end
SUBSECTION Air
  SET Dynamic viscosity = 0.05 mPa s
  set Disc speed = 30 rpm
  set Vacuum = -3 kPa
  set Gravity = 0, 0, -981 cm/s2
  set Levels = 1, 2, \
               3.5 mm
  set Title = x = 1, "quoted"
  set Series = a, b c
  set Drag law = Di Felice
  set Effects = lift, drag
END
)");
  EXPECT_EQ(settings.experiment, "tank");
  EXPECT_EQ(settings.diameter, 0.003);
  EXPECT_EQ(settings.number, 109);
  EXPECT_FALSE(settings.rotate);
  EXPECT_DOUBLE_EQ(settings.angle, std::acos(-1.0) / 6);
  EXPECT_EQ(settings.fraction, 0.62);
  EXPECT_EQ(settings.viscosity, 0.05e-3);
  EXPECT_DOUBLE_EQ(settings.speed, std::acos(-1.0));
  EXPECT_EQ(settings.pressure, -3000);
  EXPECT_EQ(settings.gravity.z, -9.81);
  EXPECT_EQ(settings.levels, (std::vector<double>{0.001, 0.002, 0.0035}));
  EXPECT_EQ(settings.title, "x = 1, \"quoted\"");
  EXPECT_EQ(settings.series, (std::vector<std::string>{"a", "b c"}));
  EXPECT_EQ(settings.law, "Di Felice");
  EXPECT_EQ(settings.effects, (std::vector<std::string>{"lift", "drag"}));
  EXPECT_TRUE(parameters.is_set("Seeds/Diameter"));
  EXPECT_EQ(parameters.value("Seeds/Diameter"), "0.003");
  EXPECT_EQ(parameters.unit("Air/Dynamic viscosity"), "Pa s");
}

TEST_F(ParametersTest, SecondReadStartsFromTheDefaults) {
  read("subsection Seeds\n set Diameter = 1 mm\nend\n");
  read("subsection Seeds\n set Density = 900\nend\n");
  EXPECT_EQ(settings.diameter, 0.004);
  EXPECT_EQ(settings.density, 900);
}

TEST_F(ParametersTest, UnknownEntry) {
  EXPECT_EQ(message("\nsubsection Seeds\n  set Diametr = 1 mm\nend\n"),
            "x.prm:3: section \"Seeds\": entry \"Diametr\" is not known. Nearest valid entry: \"Diameter\".");
  EXPECT_EQ(message("set Experimnt = tank\n"),
            "x.prm:1: entry \"Experimnt\" is not known. Nearest valid entry: \"Experiment\".");
}

TEST_F(ParametersTest, EntryOfAnotherSection) {
  EXPECT_EQ(message("subsection Seeds\n  set Vacuum = 0\nend\n"),
            "x.prm:2: section \"Seeds\": entry \"Vacuum\" is not known. There is an entry of that name at "
            "\"Air/Vacuum\".");
}

TEST_F(ParametersTest, UnknownSectionIsNamedOnce) {
  EXPECT_EQ(message("subsection Sedes\n set Diameter = 1\n set Density = 2\nend\n"),
            "x.prm:1: section \"Sedes\" is not known. Nearest valid section: \"Seeds\".");
  EXPECT_EQ(message("subsection Seeds\n subsection Strat\n end\nend\n"),
            "x.prm:2: section \"Seeds\": section \"Strat\" is not known. Nearest valid section: \"Start\".");
}

TEST_F(ParametersTest, WrongType) {
  EXPECT_EQ(
      message("subsection Seeds\n set Diameter = big\nend\n"),
      "x.prm:2: section \"Seeds\": entry \"Diameter\" = \"big\": \"big\" is not a number. Expected: a number "
      "in m, greater than 0 and at most 0.1.");
  EXPECT_EQ(
      message("subsection Seeds\n set Sub-spheres = 3.5\nend\n"),
      "x.prm:2: section \"Seeds\": entry \"Sub-spheres\" = \"3.5\": \"3.5\" is not an integer. Expected: an "
      "integer, at least 1 and at most 1000.");
  EXPECT_EQ(message("subsection Seeds\n set Rotate = maybe\nend\n"),
            "x.prm:2: section \"Seeds\": entry \"Rotate\" = \"maybe\": \"maybe\" is neither true nor false. "
            "Expected: true or false.");
  EXPECT_EQ(
      message("subsection Air\n set Drag law = DiFelice\nend\n"),
      "x.prm:2: section \"Air\": entry \"Drag law\" = \"DiFelice\": \"DiFelice\" is not one of its values. "
      "Nearest valid value: \"Di Felice\". Expected: one of Schiller-Naumann, Di Felice, Gidaspow.");
  EXPECT_EQ(message("subsection Air\n set Gravity = 1, 2\nend\n"),
            "x.prm:2: section \"Air\": entry \"Gravity\" = \"1, 2\": 2 numbers were given, three are needed. "
            "Expected: three numbers x, y, z in m/s2.");
  EXPECT_NE(message("subsection Air\n set Levels = 1 mm, 2, 3\nend\n").find("others have none"),
            std::string::npos);
  EXPECT_NE(message("subsection Seeds\n set Diameter =\nend\n").find("it is empty"), std::string::npos);
  EXPECT_NE(message("subsection Seeds\n set Density = nan\nend\n").find("not a finite number"),
            std::string::npos);
}

TEST_F(ParametersTest, OutOfBounds) {
  EXPECT_EQ(
      message("subsection Seeds\n set Diameter = 400 mm\nend\n"),
      "x.prm:2: section \"Seeds\": entry \"Diameter\" = \"400 mm\": 0.4 m is out of bounds. Allowed: greater "
      "than 0 and at most 0.1 m.");
  EXPECT_NE(message("subsection Seeds\n set Diameter = 0\nend\n").find("0 m is out of bounds"),
            std::string::npos);
  EXPECT_EQ(message("subsection Seeds\n set Sub-spheres = 0\nend\n"),
            "x.prm:2: section \"Seeds\": entry \"Sub-spheres\" = \"0\": 0 is out of bounds. Allowed: at "
            "least 1 and "
            "at most 1000.");
}

TEST_F(ParametersTest, WrongUnit) {
  EXPECT_EQ(
      message("subsection Seeds\n set Diameter = 4 mg\nend\n"),
      "x.prm:2: section \"Seeds\": entry \"Diameter\" = \"4 mg\": the unit \"mg\" does not measure the same "
      "as m. Accepted: m, mm, um, cm, km. Expected: a number in m, greater than 0 and at most 0.1.");
  EXPECT_NE(message("subsection Air\n set Disc speed = 3 Hz\nend\n").find("Accepted: rad/s, deg/s, rpm."),
            std::string::npos);
}

TEST_F(ParametersTest, DuplicatedEntry) {
  EXPECT_EQ(
      message("subsection Seeds\n set Density = 1\nend\nsubsection Seeds\n set Density = 2\nend\n"),
      "x.prm:5: section \"Seeds\": entry \"Density\" is set twice, first at x.prm:2 (\"1\"). Remove one of "
      "them.");
}

TEST_F(ParametersTest, AllMistakesAreListed) {
  EXPECT_EQ(message("set Experimnt = tank\nsubsection Air\n set Vacuum = 1\nend\n"),
            "x.prm:1: entry \"Experimnt\" is not known. Nearest valid entry: \"Experiment\".\n"
            "x.prm:3: section \"Air\": entry \"Vacuum\" = \"1\": 1 Pa is out of bounds. Allowed: at least "
            "-1e+05 and "
            "at most 0 Pa.");
}

TEST_F(ParametersTest, Overrides) {
  read("subsection Seeds\n set Diameter = 1 mm\nend\n",
       {"Seeds/Diameter=2 mm", "Seeds/Start/Fraction = 0.5"});
  EXPECT_EQ(settings.diameter, 0.002);
  EXPECT_EQ(settings.fraction, 0.5);
  EXPECT_EQ(
      message("", {"Seeds/Diametr=1"}),
      "--set \"Seeds/Diametr=1\": section \"Seeds\": entry \"Diametr\" is not known. Nearest valid entry: "
      "\"Diameter\".");
  EXPECT_EQ(message("", {"Sedes/Diameter=1"}),
            "--set \"Sedes/Diameter=1\": section \"Sedes\" is not known. Nearest valid section: \"Seeds\".");
  EXPECT_EQ(message("", {"Diameter=1"}),
            "--set \"Diameter=1\": entry \"Diameter\" is not known. There is an entry of that name at "
            "\"Seeds/Diameter\".");
  EXPECT_EQ(message("", {"Seeds/Diameter"}),
            "--set \"Seeds/Diameter\": has no name or no '='; write --set \"Section/Entry=value\".");
  EXPECT_NE(message("", {"Seeds/Density=1", "Seeds/Density=2"})
                .find("set twice, first at --set \"Seeds/Density=1\""),
            std::string::npos);
}

TEST_F(ParametersTest, CrossChecksAreRejectedWhereTheEntryStands) {
  const auto rejected = [&](const std::string& path) {
    try {
      parameters.reject(path, "a seed of this size does not fit the box.", "Make the box larger.");
    } catch (const InputError& error) {
      return std::string(error.what());
    }
  };
  read("subsection Seeds\n set Diameter = 50 mm\nend\n");
  EXPECT_EQ(rejected("Seeds/Diameter"), (folder / "x.prm").string() +
                                            ":2: section \"Seeds\": entry \"Diameter\" = \"50 mm\": a seed "
                                            "of this size does not fit the box. Make "
                                            "the box larger.");
  EXPECT_EQ(
      rejected("Seeds/Density"),
      (folder / "x.prm").string() +
          ": section \"Seeds\": entry \"Density\" (default 1000 kg/m3): a seed of this size does not fit the "
          "box. Make the box larger.");
  EXPECT_THROW(parameters.value("Seeds/Diametr"), InputError);
}

TEST_F(ParametersTest, WrittenFileIsReadBackIdentically) {
  read(
      "subsection Seeds\n set Diameter = 3.3333333333 mm\n subsection Start\n set Friction angle = 17 deg\n "
      "end\nend\n"
      "subsection Air\n set Disc speed = 33.3 rpm\n set Levels = 0.1, 0.2, 0.3 mm\n set Effects = drag\n"
      " set Title = one, two = three\nend\n");
  std::ostringstream first;
  parameters.write(first);

  Settings again;
  Parameters other;
  again.declare(other);
  other.read(write(first.str(), "used.prm"));
  EXPECT_EQ(again.diameter, settings.diameter);
  EXPECT_EQ(again.angle, settings.angle);
  EXPECT_EQ(again.speed, settings.speed);
  EXPECT_EQ(again.levels, settings.levels);
  EXPECT_EQ(again.effects, settings.effects);
  EXPECT_EQ(again.title, settings.title);
  EXPECT_EQ(again.gravity.z, settings.gravity.z);
  std::ostringstream second;
  other.write(second);
  EXPECT_EQ(first.str(), second.str());
  EXPECT_NE(first.str().find("# Of the equal-volume sphere."), std::string::npos);
  EXPECT_NE(first.str().find("set Diameter = 0.0033333333333"), std::string::npos);
}

TEST_F(ParametersTest, FilesAreRelativeToTheFileThatNamesThem) {
  write("subsection Seeds\n set Shape = corn.stl\n set Density = 1\nend\n", "sub/base.prm");
  read("include sub/base.prm\nsubsection Seeds\n set Density = 2\nend\n");
  EXPECT_EQ(settings.shape, (folder / "sub" / "corn.stl").string());
  EXPECT_EQ(settings.density, 2);  // a file may set again what it includes
  EXPECT_EQ(parameters.resolve("a.csv"), (folder / "a.csv").string());
  EXPECT_EQ(parameters.resolve("/a.csv"), "/a.csv");
  read("", {"Seeds/Shape=corn.stl"});
  EXPECT_EQ(settings.shape, (fs::current_path() / "corn.stl").string());
}

TEST_F(ParametersTest, ReferenceNamesUnitBoundsAndDefault) {
  std::ostringstream all, air;
  parameters.describe(all);
  for (const char* part : {"Seeds/Start", "Diameter = 0.004 [m]", "Of the equal-volume sphere.",
                           "a number in m, greater than 0 and at most 0.1", "one of settling, tank"})
    EXPECT_NE(all.str().find(part), std::string::npos) << part;
  parameters.describe(air, "Air");
  EXPECT_EQ(air.str().find("Diameter"), std::string::npos);
  EXPECT_NE(air.str().find("Vacuum"), std::string::npos);
  try {
    parameters.describe(air, "Seeds/Strat");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "section \"Seeds/Strat\" is not known. Nearest valid section: \"Start\".");
  }
}

TEST_F(ParametersTest, DeclarationMistakesAreFoundAtOnce) {
  double value = -1;
  EXPECT_THROW(parameters.number("Length", value, "m", Range::positive(), ""), std::logic_error);
  EXPECT_THROW(parameters.number("Length", value, "mm", Range::any(), ""), std::logic_error);
  EXPECT_THROW(parameters.number("Length", value, "metre", Range::any(), ""), std::exception);
  EXPECT_THROW(parameters.text("Experiment", settings.title, ""), std::logic_error);
}

}  // namespace
}  // namespace seedflow
