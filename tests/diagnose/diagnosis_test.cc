// The loop end to end on data whose answer is known. The data are made by the model itself, so this tests the
// workflow, not the physics; independent truths are the business of the benchmark.
#include "seedflow/diagnose/diagnosis.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "falling_seed.h"
#include "seedflow/base/error.h"
#include "seedflow/diagnose/run_store.h"

namespace seedflow {
namespace {

using testing::falling_seeds;
using testing::measure;

std::string report(const Diagnosis& d) {
  std::string text = verdict_name(d.verdict) + ": " + d.sentence;
  for (const auto& remark : d.remarks) text += "\n" + remark;
  for (std::size_t i = 0; i < std::min<std::size_t>(4, d.explanations.size()); ++i) {
    text += "\n  ";
    for (const auto& name : d.explanations[i].names) text += name + ", ";
    text += d.explanations[i].input + " " + std::to_string(d.explanations[i].log_evidence_all);
  }
  return text;
}

TEST(Diagnosis, NamesAddedMassAndRecoversItsAmplitude) {
  Problem p = falling_seeds("added_mass");
  measure(p, {{"Effects/Added mass/Strength", 0.85}}, 0.01, 1);
  const Diagnosis d = diagnose(p);
  ASSERT_EQ(d.verdict, Verdict::named) << report(d);
  ASSERT_EQ(d.effects.size(), 1u) << report(d);
  EXPECT_EQ(d.effects[0].name, "Added mass");
  // Within three times the stated standard deviation (the interval is +-1.96 of it).
  const Interval a = d.effects[0].amplitude;
  EXPECT_NEAR(a.value, 0.85, 3 * (a.high - a.low) / 3.92);
  EXPECT_GT(d.explained, 0.8);
  for (const Gap& gap : d.gaps)
    if (gap.held_out) EXPECT_LT(gap.chi2_after, 2) << report(d);
}

TEST(Diagnosis, NothingIsNamedWhereNothingIsMissing) {
  RunStore store;
  Problem p = falling_seeds("nothing");
  int named = 0;
  for (unsigned seed = 1; seed <= 30; ++seed) {
    p.measurements.clear();
    measure(p, {}, 0.02, seed);
    const Diagnosis d = diagnose(p, store);
    if (d.verdict != Verdict::none) ++named, ADD_FAILURE() << seed << " " << report(d);
  }
  EXPECT_EQ(named, 0);
}

TEST(Diagnosis, AnInputThatIsOffIsNoEffect) {
  Problem p = falling_seeds("input");
  measure(p, {{"Air/Dynamic viscosity", 0.0025}}, 0.01, 1);  // 25 % or 12 standard uncertainties
  const Diagnosis d = diagnose(p);
  EXPECT_NE(d.verdict, Verdict::named) << report(d);
  if (d.verdict == Verdict::input_uncertain) EXPECT_EQ(d.input, "fluid viscosity") << report(d);
}

TEST(Diagnosis, ACoarseTimeStepIsNotAMissingEffect) {
  Problem p = falling_seeds("coarse");
  measure(p, {{"Run/Time step", 1e-4}}, 0.001, 1, 4);  // values every 75 ms, so that a step may be as long
  p.overrides = {"Run/Time step=0.075"};
  const Diagnosis d = diagnose(p);
  EXPECT_EQ(d.verdict, Verdict::numerics_dominate) << report(d);
}

TEST(Diagnosis, FindsALawOutsideTheCatalogueWithItsExponent) {
  Problem p = falling_seeds("law");
  // Extra drag 0.02 Re^0.6 of the drag there is: 25 % at Re = 60.
  measure(p,
          {{"Effects/Inferred law/Strength", 1},
           {"Effects/Inferred law/Coefficient Slip", 0.02},
           {"Effects/Inferred law/Exponent Reynolds number", 0.6}},
          0.005, 1);
  const Diagnosis d = diagnose(p);
  ASSERT_EQ(d.verdict, Verdict::not_in_catalogue) << report(d);
  ASSERT_TRUE(d.law.found);
  EXPECT_EQ(d.law.direction, "Slip");
  ASSERT_EQ(d.law.factors.size(), 1u) << d.law.text;
  EXPECT_NEAR(d.law.factors[0].exponent.value, 0.6, 0.25) << d.law.text;
}

// A stream that grows exponentially with the height is no power of a dimensionless group: whatever law comes
// nearest must be worth adding, or not be added.
TEST(Diagnosis, ALawThatExplainsLittleIsNotAdded) {
  Problem p = falling_seeds("stream");
  Problem with_stream = p;
  for (Condition& c : with_stream.conditions)
    c.overrides.push_back("Air/Prescribed/Velocity z=-0.03*exp(-z/0.03)");
  measure(with_stream, {}, 0.01, 5);
  p.measurements = with_stream.measurements;
  const Diagnosis d = diagnose(p);
  ASSERT_EQ(d.verdict, Verdict::not_in_catalogue) << report(d);
  EXPECT_EQ(d.law.found, !d.overrides.empty());
  if (d.law.found) {
    EXPECT_GT(d.explained, 0.5) << report(d);
  } else {
    EXPECT_NE(report(d).find("No law of the library"), std::string::npos) << report(d);
  }
}

TEST(Diagnosis, RunsAreNotRepeatedAfterAnInterruption) {
  const auto folder = testing::scratch("resumed");
  std::filesystem::remove_all(folder / "store");
  Problem p = falling_seeds("resumed");
  measure(p, {{"Effects/Added mass/Strength", 1}}, 0.02, 1);
  Diagnosis first;
  {
    RunStore store(folder / "store");
    first = diagnose(p, store);
  }
  EXPECT_GT(first.runs_computed, 50);
  RunStore store(folder / "store");
  const Diagnosis again = diagnose(p, store);
  EXPECT_EQ(again.runs_computed, 0);

  // Every run is on record with the command that makes it, remembered or not.
  ASSERT_EQ(again.run_list.size(), first.run_list.size());
  EXPECT_GT(again.run_list.size(), 50u);
  for (std::size_t i = 0; i < again.run_list.size(); ++i) {
    EXPECT_EQ(again.run_list[i].command, first.run_list[i].command);
    EXPECT_EQ(again.run_list[i].status, first.run_list[i].status);
  }
  EXPECT_EQ(again.run_list[0].status, "done");  // laws on trial may fail
  const std::string& base = again.run_list[0].command;
  EXPECT_EQ(base.rfind("./seedflow run " + p.prm + " --set \"", 0), 0u) << base;
  EXPECT_NE(base.find(p.conditions[0].overrides[0]), std::string::npos) << base;
  EXPECT_TRUE(std::any_of(again.run_list.begin(), again.run_list.end(), [](const RunRecord& r) {
    return r.command.find("--set \"Effects/Added mass/Strength=0.6\"") != std::string::npos;
  }));
}

TEST(Diagnosis, TheBudgetOfRunsHoldsDuringTheSearch) {
  Problem p = falling_seeds("budget");
  measure(p, {{"Effects/Added mass/Strength", 1}}, 0.01, 1);
  p.candidates = {{"Added mass", {{"Effects/Added mass/Strength", 0, 1}}},
                  {"History force", {{"Effects/History force/Strength", 0, 1}}}};
  p.budget.runs = 4 * (2 + 6 + 2) * 6;  // just not frugal: all that is wanted takes more
  const Diagnosis d = diagnose(p);
  EXPECT_LE(d.runs, p.budget.runs) << report(d);
  EXPECT_NE(report(d).find("budget"), std::string::npos) << report(d);
}

TEST(Diagnosis, ACrashingConditionIsReportedAndSurvived) {
  Problem p = falling_seeds("crash");
  measure(p, {{"Effects/Added mass/Strength", 1}}, 0.01, 1);
  // The seed is wider than its tube under one condition, which only the wall effect minds.
  p.conditions[1].overrides.push_back("Air/Prescribed/Velocity z=1/(z-z)");
  try {
    const Diagnosis d = diagnose(p);
    EXPECT_TRUE(std::any_of(d.run_list.begin(), d.run_list.end(), [](const RunRecord& r) {
      return r.condition == "d = 1 mm" && r.status != "done";
    }));
    EXPECT_FALSE(d.remarks.empty());
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("d = 1 mm"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace seedflow
