#include "seedflow/experiment/measurements.h"

#include <cmath>

#include "tiny_run.h"

namespace seedflow {
namespace {

const std::string header = "condition,quantity,unit,coordinate,coordinate_unit,value,standard_uncertainty\n";

class MeasurementsTest : public TinyRun {
 protected:
  template <class Read>
  std::string error_of(Read read, const std::string& text) const {
    const std::string file = write("data.csv", text);
    try {
      read(file);
    } catch (const InputError& error) {
      std::string message = error.what();
      return message.compare(0, file.size(), file) == 0 ? message.substr(file.size()) : message;
    }
    return "no error";
  }
  std::string measurements(const std::string& rows) const {
    return error_of(read_measurements, header + rows);
  }
  std::string conditions(const std::string& text) const { return error_of(read_conditions, text); }
};

TEST_F(MeasurementsTest, ValuesAreRead) {
  const auto all = read_measurements(write("data.csv", "# by PIV\n" + header +
                                                           "slow,velocity,m/s, 0.5 ,s,1.25e-2,1e-3\n\n"
                                                           "slow,angle of repose,deg,,,24.0,0.5\r\n"));
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].condition, "slow");
  EXPECT_EQ(all[0].quantity, "velocity");
  EXPECT_EQ(all[0].unit, "m/s");
  EXPECT_EQ(all[0].coordinate, 0.5);
  EXPECT_EQ(all[0].coordinate_unit, "s");
  EXPECT_EQ(all[0].value, 0.0125);
  EXPECT_EQ(all[0].standard_uncertainty, 1e-3);
  EXPECT_EQ(all[0].line, 3);
  EXPECT_EQ(all[1].quantity, "angle of repose");
  EXPECT_TRUE(std::isnan(all[1].coordinate));
  EXPECT_EQ(all[1].line, 5);
}

TEST_F(MeasurementsTest, RepeatedMeasurementsAreTwoValues) {
  EXPECT_EQ(read_measurements(write("data.csv", header + "a,v,m/s,1,s,2,0.1\na,v,m/s,1,s,3,0.1\n")).size(),
            2u);
}

TEST_F(MeasurementsTest, Malformed) {
  EXPECT_EQ(measurements("a,v,m/s,1,s,nan,0.1\n"), ":2: the value \"nan\" is not a finite number.");
  EXPECT_EQ(measurements("a,v,m/s,1,s,inf,0.1\n"), ":2: the value \"inf\" is not a finite number.");
  EXPECT_EQ(measurements("a,v,m/s,1,s,,0.1\n"), ":2: the value \"\" is not a finite number.");
  EXPECT_EQ(measurements("a,v,m/s,1 s,s,1,0.1\n"), ":2: the coordinate \"1 s\" is not a finite number.");
  EXPECT_EQ(
      measurements("a,v,m/s,1,s,2,0\n"),
      ":2: the standard uncertainty 0 must be positive. If it is not known, estimate it; zero would mean a "
      "perfect measurement.");
  EXPECT_NE(measurements("a,v,m/s,1,s,2,-0.1\n").find(":2: the standard uncertainty -0.1 must be positive."),
            std::string::npos);
  EXPECT_EQ(measurements("a,v,m/s,1,s,2,0.1\n# again\na,v,m/s,1.0,s,2.0,0.1\n"),
            ":4: this point stands in the file twice.");
  EXPECT_EQ(measurements("a,v,,1,s,2,0.1\n"), ":2: v has no unit. Write 1 for a pure number.");
  EXPECT_EQ(measurements("a,v,m/s,1,,2,0.1\n"), ":2: the coordinate has no unit. Write 1 for a pure number.");
  EXPECT_EQ(measurements("a,v,m/s,,s,2,0.1\n"), ":2: the coordinate is missing, but its unit is given.");
  EXPECT_EQ(measurements(",v,m/s,1,s,2,0.1\n"), ":2: the condition is missing.");
  EXPECT_EQ(measurements("a,,m/s,1,s,2,0.1\n"), ":2: the quantity is missing.");
  EXPECT_EQ(measurements("a,v,m/s,1,s,2\n"), ":2: 6 fields, but the header has 7.");
  EXPECT_EQ(measurements(""), ": there is no measurement below the header.");
  EXPECT_EQ(error_of(read_measurements, "# nothing\n"), ": the file is empty.");
  EXPECT_EQ(error_of(read_measurements, "condition,value\na,1\n"),
            ":1: the column \"quantity\" is missing. The columns are "
            "condition,quantity,unit,coordinate,coordinate_unit,value,standard_uncertainty.");
  EXPECT_NE(error_of(read_measurements, "condition;value\na;1,5\n").find("separated by semicolons"),
            std::string::npos);
  EXPECT_NE(
      measurements("a,v,m/s,1,s,0,2 %\n").find(":2: the standard uncertainty 2 % of 0 must be positive."),
      std::string::npos);
  EXPECT_EQ(measurements("\"a,v,m/s,1,s,2,0.1\n"), ":2: a quotation mark is not closed.");
  EXPECT_THROW(read_measurements(folder / "none.csv"), InputError);
}

// As a spreadsheet may write them.
TEST_F(MeasurementsTest, OtherOrderQuotesPercentagesEmptyColumnsByteOrderMark) {
  const auto all =
      read_measurements(write("data.csv",
                              "\xEF\xBB\xBFvalue,standard_uncertainty,quantity,unit,condition,,\r\n"
                              "-20,2.5 %,angle of repose,\xC2\xB0,\"thin, slow\",,\r\n"
                              ",,,,,,\r\n"
                              "3,0.1,angle of repose,deg,\"a \"\"b\"\"\",,\r\n"));
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].condition, "thin, slow");
  EXPECT_EQ(all[0].value, -20);
  EXPECT_DOUBLE_EQ(all[0].standard_uncertainty, 0.5);
  EXPECT_TRUE(std::isnan(all[0].coordinate));
  EXPECT_EQ(all[1].condition, "a \"b\"");
  EXPECT_EQ(all[1].line, 4);
  const auto conditions = read_conditions(write(
      "data.csv", "Air/Density [kg/m3],Seeds/Sub-spheres [-],condition\n970,1,thin\n,36,\"thick, slow\"\n"));
  ASSERT_EQ(conditions.size(), 2u);
  EXPECT_FALSE(conditions[0].held_out);
  EXPECT_EQ(conditions[0].overrides,
            (std::vector<std::string>{"Air/Density=970 kg/m3", "Seeds/Sub-spheres=1"}));
  EXPECT_EQ(conditions[1].name, "thick, slow");
  EXPECT_EQ(conditions[1].overrides, (std::vector<std::string>{"Seeds/Sub-spheres=36"}));
}

TEST_F(MeasurementsTest, ConditionsAreOverrides) {
  const auto all = read_conditions(write(
      "data.csv",
      "condition,held_out,Air/Density [kg/m3],Seeds/Sub-spheres [1]\nthin,no,970,1\nthick,yes,960,36\n"));
  ASSERT_EQ(all.size(), 2u);
  EXPECT_FALSE(all[0].held_out);
  EXPECT_EQ(all[0].overrides, (std::vector<std::string>{"Air/Density=970 kg/m3", "Seeds/Sub-spheres=1"}));
  EXPECT_TRUE(all[1].held_out);
  EXPECT_EQ(all[1].name, "thick");
}

TEST_F(MeasurementsTest, MalformedConditions) {
  EXPECT_EQ(conditions("name,held_out\na,no\n"),
            ":1: the column \"condition\" is missing. The header is condition,held_out and one column per "
            "entry that "
            "differs, as in Seeds/Diameter [mm].");
  EXPECT_EQ(conditions("condition,held_out,Air/Density\na,no,1\n"),
            ":1: column \"Air/Density\" has no unit. Write it in brackets, as in Air/Density [kg/m3]; [1] "
            "for none.");
  EXPECT_EQ(conditions("condition,held_out\na,maybe\n"), ":2: held_out must be yes or no, not \"maybe\".");
  EXPECT_EQ(conditions("condition,held_out\na,no\na,yes\n"), ":3: the condition \"a\" stands here twice.");
  EXPECT_EQ(conditions("condition,held_out\n,no\n"), ":2: the name of the condition is missing.");
  EXPECT_EQ(conditions("condition,held_out\n"), ": there is no condition below the header.");
}

// The experiment that uses them.
class TankInputTest : public MeasurementsTest {
 protected:
  RunOutcome tank(const std::string& condition_text, const std::string& rows) const {
    std::string prm = tiny_settling;
    prm.replace(prm.find("= settling"), 10, "= settling tank");
    write("tank.prm",
          prm + "subsection Comparison\n  set Measurements = m.csv\n  set Conditions = c.csv\nend\n");
    if (!rows.empty()) write("m.csv", header + rows);
    write("c.csv", condition_text);
    return run_here({(folder / "tank.prm").string(), "--output", out().string()});
  }
  void expect_message(const RunOutcome& result, const std::string& message) const {
    EXPECT_EQ(result.status, exit_bad_input);
    expect_contains(result.message, message);
  }
};

TEST_F(TankInputTest, WhatTheExperimentCannotUse) {
  const std::string one = "condition,held_out,Air/Density [kg/m3]\na,no,1000\n",
                    row = "a,velocity,m/s,5e-3,s,0.01,1e-3\n";
  expect_message(tank(one, ""), "m.csv': there is no such file.");
  expect_message(tank(one, "a,velocity,mm/s,5e-3,s,0.01,1e-3\n"),
                 "m.csv:2: this experiment produces the quantity velocity [m/s] over time [s], not velocity "
                 "[mm/s] over [s].");
  expect_message(tank(one, "a,velocity,m/s,,,0.01,1e-3\n"), "m.csv:2: ");
  expect_message(tank(one, row + "b,velocity,m/s,5e-3,s,0.01,1e-3\n"),
                 "m.csv:3: there is no condition \"b\"");
  expect_message(tank(one + "c,no,1000\n", row), "nothing was measured under the condition \"c\"");
  expect_message(tank(one, row + "a,velocity,m/s,0.02,s,0.01,1e-3\n"), "m.csv:3: measured at 0.02");
  expect_message(tank("condition,held_out,Air/Densty [kg/m3]\na,no,1000\n", row), "condition \"a\": ");
  expect_message(tank("condition,held_out,Air/Density [kg/m3]\na,no,-1\n", row), "out of bounds");
}

TEST_F(TankInputTest, RunsAndResumesItsConditions) {
  const std::string two = "condition,held_out,Air/Density [kg/m3]\na,no,1000\nb,yes,900\n";
  const std::string rows = "a,velocity,m/s,5e-3,s,0.01,1e-3\nb,velocity,m/s,5e-3,s,0.01,1e-3\n";
  EXPECT_EQ(tank(two, rows).status, exit_done);
  const std::string first = read_file(out() / "b" / "seeds.csv");
  // As if the run had been stopped in its first condition: the second one begins.
  std::filesystem::remove_all(out() / "b");
  std::filesystem::remove(out() / "summary.json");
  const RunOutcome again = run_here({(folder / "tank.prm").string(), "--output", out().string(), "--resume"});
  EXPECT_EQ(again.status, exit_done) << again.message;
  EXPECT_EQ(read_file(out() / "b" / "seeds.csv"), first);
  EXPECT_GT(Summary::read(out() / "summary.json").observable("b: peak velocity"), 0);
  std::filesystem::remove_all(out());
  expect_message(run_here({(folder / "tank.prm").string(), "--output", out().string(), "--resume"}),
                 "There is no checkpoint in");
}

}  // namespace
}  // namespace seedflow
