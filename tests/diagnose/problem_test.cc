// Bad input: every message says what is wrong and where.
#include <gtest/gtest.h>

#include "falling_seed.h"
#include "seedflow/base/error.h"
#include "seedflow/diagnose/problem_file.h"

namespace seedflow {
namespace {

using testing::falling_seeds;
using testing::measure;
using testing::scratch;
using testing::write;

template <class Act>
std::string message(const Act& act) {
  try {
    act();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

void expect_words(const std::string& text, const std::vector<std::string>& words) {
  for (const std::string& word : words)
    EXPECT_NE(text.find(word), std::string::npos) << word << " in: " << text;
}

Problem measured() {
  Problem p = falling_seeds("bad");
  measure(p, {}, 0.02, 1, 5);
  p.candidates = {{"Added mass", {{"Effects/Added mass/Strength", 0, 1}}}};
  return p;
}

TEST(BadProblem, Measurements) {
  const auto broken = [](const auto& breaks) {
    Problem p = measured();
    breaks(p.measurements[0]);
    return message([&] { diagnose(p); });
  };
  expect_words(broken([](Measurement& m) { m.unit = "kg"; }), {"kg", "m/s"});
  expect_words(broken([](Measurement& m) { m.unit = "metre"; }), {"metre"});
  expect_words(broken([](Measurement& m) { m.unit = ""; }), {"no unit"});
  expect_words(broken([](Measurement& m) { m.coordinate_unit = "m"; }), {"coordinate", "\"m\""});
  expect_words(broken([](Measurement& m) { m.quantity = "velocty"; }), {"velocty", "velocity"});
  expect_words(broken([](Measurement& m) { m.condition = "d = 3 mm"; }), {"d = 3 mm", "condition"});
  expect_words(broken([](Measurement& m) { m.standard_uncertainty = 0; }), {"uncertainty", "positive"});
  expect_words(broken([](Measurement& m) { m.standard_uncertainty = -1; }), {"uncertainty", "positive"});
  expect_words(broken([](Measurement& m) { m.value = std::nan(""); }), {"not a finite number"});
  expect_words(broken([](Measurement& m) { m.coordinate = std::nan(""); }), {"time"});
}

TEST(BadProblem, TheFileOfAnExperimentIsNoDiagnosis) {
  const std::string file = falling_seeds("experiment").prm;
  expect_words(message([&] { read_problem(file, {}); }),
               {"model.prm:1", "single seed", "set Model", "Measurements"});
}

TEST(BadProblem, ConditionsCandidatesInputsBudget) {
  Problem p = measured();
  p.conditions[2].overrides = {"Seeds/Diamter=1 mm"};
  expect_words(message([&] { diagnose(p); }), {"d = 1.5 mm", "Diamter", "Diameter"});
  p = measured();
  p.conditions.push_back({"unmeasured", false, {}});
  expect_words(message([&] { diagnose(p); }), {"nothing was measured", "unmeasured"});
  p = measured();
  for (Condition& c : p.conditions) c.held_out = true;
  expect_words(message([&] { diagnose(p); }), {"held_out"});
  p = measured();
  p.candidates = {{"Added mas", {{"Effects/Added mas/Strength", 0, 1}}}};
  expect_words(message([&] { diagnose(p); }), {"Added mas", "Added mass"});
  p = measured();
  p.nuisances = {{"size", "Seeds/Size", 0.01}};
  expect_words(message([&] { diagnose(p); }), {"Seeds/Size"});
  p = measured();
  p.budget.runs = 3;
  expect_words(message([&] { diagnose(p); }), {"budget", "3"});
}

TEST(ProblemFile, ReadsWhatItNames) {
  const auto folder = scratch("file");
  write(folder / "model.prm", "set Experiment = single seed\n");
  write(folder / "c.csv", "condition,held_out,Seeds/Diameter [mm]\na,no,1\nb,yes,2\n");
  write(folder / "m.csv",
        "# correlated,velocity,m/s,0.01,s,0.5\n"
        "condition,quantity,unit,coordinate,coordinate_unit,value,standard_uncertainty\n"
        "a,velocity,m/s,0.1,s,0.1,0.01\nb,velocity,m/s,0.1,s,0.2,0.01\n");
  const std::string file = write(folder / "d.prm",
                                 "set Model = model.prm\nset Measurements = m.csv\nset Conditions = c.csv\n"
                                 "set Candidates = Added mass, Vessel/Tube diameter = 5 cm\n"
                                 "set Nuisances = Seeds/Diameter +- 1 %, Seeds/Release time +- 2 ms each\n");
  const Problem p = read_problem(file, {"Runs=77", "Seeds/Density=2000"});
  EXPECT_EQ(p.budget.runs, 77);
  EXPECT_EQ(p.overrides, std::vector<std::string>{"Seeds/Density=2000"});
  EXPECT_TRUE(p.conditions[1].held_out);
  EXPECT_EQ(p.measurements[0].correlated_uncertainty, 0.01);
  EXPECT_EQ(p.measurements[0].correlation_length, 0.5);
  EXPECT_EQ(p.candidates[0].entries[0].path, "Effects/Added mass/Strength");
  EXPECT_NEAR(p.candidates[1].entries[0].published, 0.05, 1e-15);
  EXPECT_TRUE(p.nuisances[0].relative);
  EXPECT_NEAR(p.nuisances[0].standard_deviation, 0.01, 1e-15);
  EXPECT_TRUE(p.nuisances[1].each_condition);
  EXPECT_FALSE(p.nuisances[1].relative);
  EXPECT_NEAR(p.nuisances[1].standard_deviation, 0.002, 1e-15);

  expect_words(message([] { read_nuisance("Seeds/Diameter 1 %"); }), {"+-", "Seeds/Diameter"});
  expect_words(message([] { read_nuisance("Seeds/Diameter +- 0 %"); }), {"positive"});
  write(folder / "d.prm", "set Model = model.prm\nset Measurements = m.csv\n");
  expect_words(message([&] { read_problem(file, {}); }), {"Conditions", "missing"});
  write(folder / "d.prm",
        "set Model = model.prm\nset Measurements = m.csv\nset Conditions = c.csv\nset Candidates = Histroy "
        "force\n");
  expect_words(message([&] { read_problem(file, {}); }), {"Histroy force", "History force"});
  write(folder / "m.csv",
        "# correlated,velocity,m/s,-1,s,0.5\n"
        "condition,quantity,unit,coordinate,coordinate_unit,value,standard_uncertainty\n"
        "a,velocity,m/s,0.1,s,0.1,0.01\n");
  write(folder / "d.prm", "set Model = model.prm\nset Measurements = m.csv\nset Conditions = c.csv\n");
  expect_words(message([&] { read_problem(file, {}); }), {"m.csv:1", "positive"});
}

}  // namespace
}  // namespace seedflow
