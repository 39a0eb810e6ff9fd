// The cases of doc/diagnosis.md, as a user runs them.
#include <gtest/gtest.h>

#include <cmath>

#include "places.h"
#include "seedflow/diagnose/problem_file.h"

namespace seedflow {
namespace {

Diagnosis of_case(const std::string& name) {
  return diagnose(read_problem(std::string(places::source_dir) + "/prm/diagnosis/" + name + ".prm", {}));
}

TEST(Cases, MordantPintonNamesAddedMassAndHistory) {
  const Problem problem =
      read_problem(std::string(places::source_dir) + "/prm/diagnosis/mordant_pinton.prm", {});
  const Diagnosis d = diagnose(problem);
  ASSERT_EQ(d.verdict, Verdict::named) << d.sentence;
  ASSERT_EQ(d.effects.size(), 2u) << d.sentence;
  EXPECT_EQ(d.effects[0].name, "Added mass");
  EXPECT_EQ(d.effects[1].name, "History force");
  // Case 2 was held out: rms at most 2 % of its terminal speed, 0.218 m/s.
  double square = 0, n = 0;
  for (std::size_t i = 0; i < problem.measurements.size(); ++i)
    if (problem.measurements[i].condition == "case 2")
      square += std::pow(problem.measurements[i].value - d.after[i], 2), ++n;
  EXPECT_EQ(n, 30);
  EXPECT_LT(std::sqrt(square / n) / 0.218, 0.02);
}

TEST(Cases, NothingIsMissingFromACorrectDragLaw) {
  const Diagnosis d = of_case("sphere_drag");
  EXPECT_EQ(d.verdict, Verdict::none) << d.sentence;
}

TEST(Cases, TheWallFactorOfATubeIsNotAcceptedForATank) {
  const Diagnosis d = of_case("ten_cate");
  EXPECT_NE(d.verdict, Verdict::named) << d.sentence;
  EXPECT_NE(d.verdict, Verdict::none) << d.sentence;
}

TEST(Cases, AnUnknownDragIsFlaggedWithItsExponent) {
  const Diagnosis d = of_case("unknown_drag");
  ASSERT_EQ(d.verdict, Verdict::not_in_catalogue) << d.sentence;
  EXPECT_EQ(d.law.direction, "Slip");
  ASSERT_EQ(d.law.factors.size(), 1u);
  EXPECT_EQ(d.law.factors[0].group, "Reynolds number");
  EXPECT_NEAR(d.law.factors[0].exponent.value, 0.8, 0.1);
}

TEST(Cases, AConfoundedDesignIsResolvedByTheSuggestedExperiment) {
  const Diagnosis first = of_case("confounded");
  ASSERT_EQ(first.verdict, Verdict::ambiguous) << first.sentence;
  EXPECT_EQ(first.rivals[0], std::vector<std::string>{"Tube wall drag"});
  EXPECT_EQ(first.rivals[1], std::vector<std::string>{"Hindered settling"});
  EXPECT_TRUE(first.suggestion.found);
  const Diagnosis second = of_case("confounded_resolved");
  ASSERT_EQ(second.verdict, Verdict::named) << second.sentence;
  EXPECT_EQ(second.effects[0].name, "Tube wall drag");
}

TEST(Cases, TheTableOfThePaperIsNoPhysicsOfTheCatalogue) {
  const Diagnosis d = of_case("paper_settling");
  EXPECT_NE(d.verdict, Verdict::none) << d.sentence;
  EXPECT_NE(d.verdict, Verdict::named) << d.sentence;
}

}  // namespace
}  // namespace seedflow
