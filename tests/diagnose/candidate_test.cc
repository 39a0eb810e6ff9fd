// Effects that are a choice of the model, as candidates: by name, by default, weighed, named, written down.
#include "seedflow/diagnose/candidate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "falling_seed.h"
#include "places.h"
#include "seedflow/diagnose/command.h"
#include "seedflow/diagnose/diagnosis_files.h"
#include "seedflow/diagnose/observable_model.h"
#include "seedflow/output/folder.h"

namespace seedflow {
namespace {

const std::string drum = std::string(places::source_dir) + "/prm/diagnosis/dry/model.prm";
const std::string settling = std::string(places::source_dir) + "/prm/diagnosis/coupled/model.prm";

Measurement measurement(const std::string& condition, const std::string& quantity, double time, double value,
                        double uncertainty) {
  Measurement m;
  m.condition = condition, m.quantity = quantity, m.value = value, m.standard_uncertainty = uncertainty;
  m.unit = quantity == "velocity" ? "m/s" : "deg";
  m.coordinate = time;
  if (std::isfinite(time)) m.coordinate_unit = "s";
  return m;
}

Problem of_model(const std::string& prm, const std::vector<std::string>& overrides = {}) {
  Problem p;
  p.prm = prm;
  p.overrides = overrides;
  p.conditions = {{"as it is", false, {}}};
  if (prm == drum) p.conditions.push_back({"6 mm", false, {"Seeds/Diameter=6 mm"}});
  for (const Condition& c : p.conditions)
    p.measurements.push_back(prm == drum ? measurement(c.name, "surface angle", std::nan(""), 35, 1)
                                         : measurement(c.name, "velocity", 0.04, 0.04, 1e-3));
  return p;
}

bool offers(const ObservableModel& model, const std::string& name) {
  return std::any_of(model.candidates().begin(), model.candidates().end(),
                     [&](const Candidate& c) { return c.name == name; });
}

TEST(Candidates, OfADrumAreThoseItsFileHasAndThatAreOff) {
  RunStore store;
  const Problem plain = of_model(drum);
  const ObservableModel model(plain, store);
  for (const char* name :
       {"Air drag", "Size distribution", "Multi-contact normalisation", "Rolling friction"})
    EXPECT_TRUE(offers(model, name)) << name;
  for (const char* name : {"Drag shared per seed", "Undisturbed velocity", "Drag", "Seal leak"})
    EXPECT_FALSE(offers(model, name)) << name;
  const Problem has_all = of_model(drum, {"Effects/Air drag/Strength=1", "Filling/Diameter deviation=0.2 mm",
                                          "Seeds motion/Contacts/Normalise multiple contacts=true"});
  const ObservableModel full(has_all, store);
  for (const char* name : {"Air drag", "Size distribution", "Multi-contact normalisation"})
    EXPECT_FALSE(offers(full, name)) << name;
  EXPECT_EQ(store.computed(), 0);
}

TEST(Candidates, OfAResolvedFlowAreTheChoicesOfTheCoupling) {
  RunStore store;
  const Problem plain = of_model(settling);
  const ObservableModel literal(plain, store);
  EXPECT_TRUE(offers(literal, "Drag shared per seed"));
  EXPECT_TRUE(offers(literal, "Undisturbed velocity"));
  EXPECT_FALSE(offers(literal, "Air drag"));
  const Problem one_drag = of_model(settling, {"Coupling/Drag on=seed"});
  const ObservableModel shared(one_drag, store);
  EXPECT_FALSE(offers(shared, "Drag shared per seed"));
  EXPECT_TRUE(offers(shared, "Undisturbed velocity"));
}

// 5 % of the diameter that every condition has; of the base model's own in what is written down.
TEST(Candidates, TheSizeDistributionGoesWithTheDiameter) {
  RunStore store;
  Problem p = of_model(drum);
  p.candidates = {read_candidate("Size distribution")};
  const ObservableModel model(p, store);
  Setting setting;
  setting.amplitude[0] = 1.2;
  const auto only = [](const std::vector<std::pair<std::string, double>>& changes) {
    EXPECT_EQ(changes.size(), 1u);
    EXPECT_EQ(changes.at(0).first, "Filling/Diameter deviation");
    return changes.at(0).second;
  };
  EXPECT_NEAR(only(model.changes(setting, 0)), 1.2 * 0.05 * 4e-3, 1e-15);
  EXPECT_NEAR(only(model.changes(setting, 1)), 1.2 * 0.05 * 6e-3, 1e-15);
  std::swap(p.conditions[0], p.conditions[1]);
  const ObservableModel swapped(p, store);
  EXPECT_NEAR(only(swapped.changes(setting, 0)), 1.2 * 0.05 * 6e-3, 1e-15);
  EXPECT_NEAR(only(swapped.changes(setting)), 1.2 * 0.05 * 4e-3, 1e-15);
}

TEST(Candidates, ByNameAreTheEntryThatStandsForThem) {
  const Candidate drag = read_candidate("Drag shared per seed");
  EXPECT_EQ(drag.name, "Drag shared per seed");
  EXPECT_TRUE(drag.entries.empty());
  EXPECT_EQ(drag.choices, std::vector<std::string>{"Coupling/Drag on=seed"});
  const Candidate air = read_candidate("Air drag");
  ASSERT_EQ(air.entries.size(), 1u);
  EXPECT_EQ(air.entries[0].path, "Effects/Air drag/Strength");
  EXPECT_TRUE(air.choices.empty());
}

TEST(Candidates, ADryRunListsThemAndRunsNothing) {
  const auto folder = testing::scratch("dry_run");
  std::filesystem::remove_all(folder / "out");
  testing::write(folder / "c.csv", "condition,held_out\nas it is,no\n");
  testing::write(folder / "m.csv",
                 "condition,quantity,unit,value,standard_uncertainty\nas it is,surface angle,deg,35,1\n");
  const std::string file =
      testing::write(folder / "d.prm", "set Model = " + drum +
                                           "\nset Measurements = m.csv\nset Conditions = "
                                           "c.csv\nset Repeats = 2\n");
  std::ostringstream said;
  const Command command = diagnose_command();
  EXPECT_EQ(command.execute(CommandLine(), {file, "--dry-run", "--output", (folder / "out").string()}, said),
            0);
  EXPECT_NE(said.str().find("Size distribution, Multi-contact normalisation, Air drag\n"), std::string::npos)
      << said.str();
  // Eight candidates (all of contacts and the three), six inputs (two of the drum, diameter, density,
  // friction with both materials), base and winner, twice.
  EXPECT_NE(said.str().find("at least 32,"), std::string::npos) << said.str();
  EXPECT_FALSE(std::filesystem::exists(folder / "out"));
}

/// The coupled model for a few air steps on few cells: a tenth of a second of computing.
Problem short_settling() {
  Problem p;
  p.prm = testing::write(testing::scratch("candidate") / "model.prm", R"(set Experiment = settling
subsection Run
  set End time = 0.06 s
  set Air step = 6 ms
  set Series interval = 6 ms
  set Field interval = 0
end
subsection Air domain
  set Upper corner = 24 mm, 24 mm, 36 mm
  set Cells = 4, 4, 6
end
subsection Air
  set Density = 1000 kg/m3
  set Dynamic viscosity = 0.1 Pa s
end
subsection Seeds
  set Diameter = 4 mm
  set Density = 1340 kg/m3
  set Sub-spheres = 36
  set Rigid = true
  set Position = 12 mm, 12 mm, 26 mm
end
subsection Seeds motion
  set Time step = 2.5e-6 s
end
subsection Coupling
  set Drag on = sub-sphere
  set Exchange kernel = gaussian
  set Undisturbed velocity = none
end
)");
  p.conditions = {{"plain", false, {}}, {"heavy", true, {"Seeds/Density=1800"}}};
  p.nuisances = {{"density of the seed", "Seeds/Density", 0.005}};
  p.budget = {40, 1, 1};
  return p;
}

/// Made by the model with one drag per seed, with alternating errors of 1 %.
void measure(Problem& p) {
  const auto settling_observer = [&] {
    for (const Experiment& e : experiment_catalogue())
      if (e.name == "settling") return e.observer();
    throw std::logic_error("no settling");
  }();
  for (const Condition& c : p.conditions) {
    std::vector<std::string> all = c.overrides;
    all.push_back("Coupling/Drag on=seed");
    std::vector<WantedValue> wanted;
    for (int i = 1; i <= 10; ++i) wanted.push_back({"velocity", 6e-3 * i});
    const std::vector<double> v = settling_observer.prepare(p.prm, all).observe({}, wanted);
    for (int i = 0; i < 10; ++i)
      p.measurements.push_back(measurement(c.name, "velocity", wanted[i].coordinate,
                                           v[i] + 0.01 * v[9] * (i % 3 - 1), 0.01 * v[9]));
  }
}

// A choice is named by the effect's name and stands in the written model; one that the model refuses beside
// its other choices is reported and left out, without a run.
TEST(Candidates, AChoiceIsNamedAndARefusedOneReported) {
  Problem p = short_settling();
  measure(p);
  for (const char* name : {"Drag shared per seed", "Undisturbed velocity", "Added mass"})
    p.candidates.push_back(read_candidate(name));
  const Diagnosis d = diagnose(p);
  ASSERT_EQ(d.verdict, Verdict::named) << d.sentence;
  ASSERT_EQ(d.effects.size(), 1u);
  EXPECT_EQ(d.effects[0].name, "Drag shared per seed");
  EXPECT_NEAR(d.effects[0].amplitude.value, 1, 0.1);
  EXPECT_NE(d.sentence.find("Missing: Drag shared per seed"), std::string::npos) << d.sentence;
  const std::string left_out = "Candidates whose runs failed, left out: Undisturbed velocity.";
  EXPECT_NE(std::find(d.remarks.begin(), d.remarks.end(), left_out), d.remarks.end());
  const auto refused = std::find_if(d.run_list.begin(), d.run_list.end(), [](const RunRecord& r) {
    return r.command.find("Undisturbed velocity=oseen") != std::string::npos;
  });
  ASSERT_NE(refused, d.run_list.end());
  EXPECT_NE(refused->status.find("whole seeds with the Gaussian exchange kernel only"), std::string::npos);
  const auto file = testing::scratch("candidate") / "found.diagnosed.prm";
  write_diagnosed_model(file, p, d);
  const std::string text = read_file(file);
  const std::size_t at = text.find("Drag on ");
  ASSERT_NE(at, std::string::npos);
  EXPECT_NE(text.substr(at, 40).find("= seed"), std::string::npos) << text.substr(at, 40);
}

}  // namespace
}  // namespace seedflow
