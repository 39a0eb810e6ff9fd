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

/// A problem in files, as a user has it; `break_it` changes the texts of measurements and conditions.
struct InFiles {
  std::string measurements =
      "condition,quantity,unit,coordinate,coordinate_unit,value,standard_uncertainty\n"
      "a,velocity,m/s,0.1,s,0.1,0.01\n"
      "b,velocity,m/s,0.1,s,0.2,0.01\n";
  std::string conditions = "condition,held_out,Seeds/Diameter [mm]\na,no,1\nb,no,2\n";
  std::string model = "set Experiment = single seed\nsubsection Run\n  set End time = 0.3 s\nend\n";
  std::string further = "set Candidates = Added mass\n";

  /// The message of the diagnosis, which makes no run.
  std::string refused() const {
    const auto folder = scratch("in_files");
    write(folder / "model.prm", model);
    write(folder / "m.csv", measurements);
    write(folder / "c.csv", conditions);
    write(folder / "p.csv", "condition,Seeds/Diamter [mm]\nx,3\n");
    const std::string file =
        write(folder / "d.prm",
              "set Model = model.prm\nset Measurements = m.csv\nset Conditions = c.csv\n" + further);
    RunStore store;
    const std::string text = message([&] { diagnose(read_problem(file, {}), store); });
    EXPECT_EQ(store.computed(), 0) << text;
    return text;
  }
  std::string refused_row(const std::string& third_line) {
    measurements.replace(measurements.rfind("b,"), std::string::npos, third_line + "\n");
    return refused();
  }
  std::string refused_with(const std::string& entry) {
    further = entry + "\n";
    return refused();
  }
};

TEST(BadProblem, FileAndLineOfMeasurements) {
  expect_words(InFiles().refused_row("b,velocity,kg,0.1,s,0.2,0.01"), {"m.csv:3", "\"kg\"", "m/s"});
  expect_words(InFiles().refused_row("b,velocity,metre,0.1,s,0.2,0.01"), {"m.csv:3", "metre"});
  expect_words(InFiles().refused_row("b,velocty,m/s,0.1,s,0.2,0.01"), {"m.csv:3", "velocty", "\"velocity\""});
  expect_words(InFiles().refused_row("b,velocity,m/s,0.1,m,0.2,0.01"), {"m.csv:3", "coordinate", "\"m\""});
  expect_words(InFiles().refused_row("b,velocity,m/s,,,0.2,0.01"), {"m.csv:3", "time"});
  expect_words(InFiles().refused_row("b,terminal velocity,m/s,0.1,s,0.2,0.01"), {"m.csv:3", "no coordinate"});
  expect_words(InFiles().refused_row("c,velocity,m/s,0.1,s,0.2,0.01"), {"m.csv:3", "\"c\"", "\"b\""});
  // The same point in other units.
  expect_words(InFiles().refused_row("a,velocity,mm/s,100,ms,100,10\nb,velocity,m/s,0.1,s,0.2,0.01"),
               {"m.csv:3", "twice"});
}

TEST(BadProblem, CoordinatesThatNoRunHas) {
  expect_words(InFiles().refused_row("b,velocity,m/s,400,ms,0.2,0.01"),
               {"m.csv:3", "time 0.4 s", "0 to 0.3 s", "Run/End time"});
  expect_words(InFiles().refused_row("b,velocity,m/s,1e9,s,0.2,0.01"), {"m.csv:3", "time"});
  expect_words(InFiles().refused_row("b,velocity,m/s,-0.1,s,0.2,0.01"), {"m.csv:3", "time -0.1 s"});
  expect_words(InFiles().refused_row("b,drag coefficient,1,-5,1,0.4,0.01"),
               {"m.csv:3", "Reynolds number -5"});
  InFiles settling;
  settling.model =
      "set Experiment = settling\nsubsection Run\n  set End time = 0.3 s\nend\n"
      "subsection Air domain\n  set Upper corner = 24 mm, 24 mm, 48 mm\n  set Cells = 6, 6, 12\nend\n"
      "subsection Seeds\n  set Sub-spheres = 36\n  set Position = 11 mm, 13 mm, 30 mm\nend\n";
  settling.conditions = "condition,held_out,Seeds/Density [kg/m3]\na,no,1300\nb,no,1500\n";
  expect_words(settling.refused_row("b,velocity,m/s,400,ms,0.2,0.01"), {"m.csv:3", "0.4 s", "Run/End time"});
  InFiles sieve;
  sieve.model = "set Experiment = slope screening\n";
  sieve.measurements.replace(sieve.measurements.find("a,velocity,m/s,0.1,s,0.1"), 24, "a,passing,%,1,1,51");
  sieve.conditions = "condition,held_out,Screen/Inclination [deg]\na,no,10\nb,no,20\n";
  expect_words(sieve.refused_row("b,passing,%,6,1,2,1"), {"m.csv:3", "area 6", "a whole number from 1 to 5"});
  expect_words(sieve.refused_row("b,passing,%,1.5,1,2,1"), {"m.csv:3", "area 1.5", "a whole number"});
  expect_words(sieve.refused_row("b,passed,%,1,1,2,1"), {"m.csv:3", "\"passed\"", "\"passing\""});
  expect_words(sieve.refused_row("b,passing,deg,1,1,2,1"), {"m.csv:3", "\"deg\""});
  InFiles heap;
  heap.model = "set Experiment = repose angle\n";
  heap.measurements.replace(heap.measurements.find("a,velocity,m/s,0.1,s,0.1"), 24,
                            "a,angle of repose,deg,,,28");
  expect_words(heap.refused_row("b,angle of repos,deg,,,28,1"), {"m.csv:3", "\"angle of repose\""});
  expect_words(heap.refused_row("b,angle left,%,,,28,1"), {"m.csv:3", "\"%\"", "rad"});
}

TEST(BadProblem, AWrongUnitBesideACorrelatedPartIsTheRows) {
  const auto with = [](const std::string& part, const std::string& row) {
    InFiles files;
    files.measurements.insert(0, "# correlated," + part + "\n");
    return files.refused_row(row);
  };
  const std::string good = "b,velocity,m/s,0.1,s,0.2,0.01";
  expect_words(with("velocity,m/s,0.01,s,0.5", "b,velocity,kg,0.1,s,0.2,0.01"), {"m.csv:4", "\"kg\""});
  expect_words(with("velocity,kg,0.01,s,0.5", good), {"m.csv:1", "correlated", "\"kg\""});
  expect_words(with("velocity,m/s,0.01,m,0.5", good), {"m.csv:1", "correlated", "\"m\""});
  expect_words(with("velocty,m/s,0.01,s,0.5", good), {"m.csv:1", "velocty"});
}

TEST(BadProblem, FileAndLineOfConditions) {
  InFiles files;
  files.conditions = "condition,held_out,Seeds/Diamter [mm]\na,no,1\nb,no,2\n";
  expect_words(files.refused(), {"c.csv:2", "\"Diamter\"", "\"Diameter\""});
  files.conditions = "condition,held_out,Seeds/Diameter [kg]\na,no,1\nb,no,2\n";
  expect_words(files.refused(), {"c.csv:2", "1 kg", "Accepted"});
  files.conditions = "condition,held_out,Seeds/Diameter [mm]\na,no,1\nb,no,-2\n";
  const std::string negative = files.refused();
  expect_words(negative, {"c.csv:3", "-2 mm", "greater than 0"});
  EXPECT_EQ(negative.find("--set"), std::string::npos) << negative;
  files.conditions = "condition,held_out,Seeds/Diameter [mm]\na,no,1\nb,no,2\nc,no,3\n";
  expect_words(files.refused(), {"c.csv:4", "nothing was measured", "\"c\""});
  files.conditions = "condition,held_out,Seeds/Diameter [mm]\na,yes,1\nb,yes,2\n";
  expect_words(files.refused(), {"c.csv:2", "held_out = no"});
}

TEST(BadProblem, FileAndLineOfTheProblemsOwnEntries) {
  expect_words(InFiles().refused_with("set Candidates = Vessel/Tub diameter = 5 cm"),
               {"d.prm:4: Candidates", "Vessel/Tub diameter"});
  expect_words(InFiles().refused_with("set Candidates = Vessel/Tube diameter = 5 kg"),
               {"d.prm:4: Candidates", "\"kg\"", "m."});
  expect_words(InFiles().refused_with("set Candidates = Histroy force"),
               {"d.prm:4: Candidates", "\"History force\""});
  expect_words(InFiles().refused_with("set Nuisances = Seeds/Diamter +- 1 %"),
               {"d.prm:4: Nuisances", "Diamter", "\"Seeds/Diameter\""});
  expect_words(InFiles().refused_with("set Nuisances = Seeds/Diameter +- 1 kg"),
               {"d.prm:4: Nuisances", "\"kg\""});
  expect_words(InFiles().refused_with("set Nuisances = Seeds/Release time +- 1 %"),
               {"d.prm:4: Nuisances", "Seeds/Release time", "share of 0"});
  expect_words(InFiles().refused_with("set Runs = 3"), {"d.prm:4", "budget of 3"});
  expect_words(InFiles().refused_with("set Possible experiments = p.csv"),
               {"p.csv:2", "Diamter", "Diameter"});
}

TEST(BadProblem, RunsThatAllFailAreSaidSo) {
  InFiles files;
  // Sound as far as can be seen beforehand: the flow's expression has no value at the seed.
  files.model += "subsection Air\n  subsection Prescribed\n    set Velocity z = 1/(t - t)\n  end\nend\n";
  const auto folder = scratch("failing");
  write(folder / "model.prm", files.model);
  write(folder / "m.csv", files.measurements);
  write(folder / "c.csv", files.conditions);
  const std::string file =
      write(folder / "d.prm", "set Model = model.prm\nset Measurements = m.csv\nset Conditions = c.csv\n");
  try {
    diagnose(read_problem(file, {}));
    FAIL() << "no error";
  } catch (const RunError& error) {
    expect_words(error.what(), {"No condition is left", "\"a\"", "\"b\"", "Remedy"});
  }
}

TEST(BadProblem, TheFileOfAnExperimentIsNoDiagnosis) {
  const std::string file = falling_seeds("experiment").prm;
  expect_words(message([&] { read_problem(file, {}); }),
               {"model.prm:1", "single seed", "./seedflow run", "set Model", "Measurements"});
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
