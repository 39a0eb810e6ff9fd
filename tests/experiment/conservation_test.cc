// Mass, volume and momentum of whole runs, from hardly any drag to very strong drag.
#include <cmath>

#include "tiny_run.h"

namespace seedflow {
namespace {

class Conservation : public TinyRun {
 protected:
  void expect_balanced(std::vector<std::string> set) const {
    set.push_back("Run/End time=4 ms");
    std::string title;
    for (const std::string& entry : set) title += entry + "; ";
    SCOPED_TRACE(title);
    const RunOutcome result = run(set);
    ASSERT_EQ(result.status, exit_done) << result.message;  // a broken balance is a failure already
    const Summary summary = Summary::read(out() / "summary.json");
    // The bounds asked of the code; the run's own may not be wider.
    const std::vector<std::pair<std::string, double>> bounds = {
        {"air mass, every pressure test function, worst step", 1e-8},
        {"particle volume in the void fraction", 1e-12},
        {"momentum exchange seeds - air", 1e-12},
        {"momentum of seeds, air and walls", 1e-8}};
    for (const auto& [name, bound] : bounds) {
      const auto& all = summary.balances();
      const auto found = std::find_if(all.begin(), all.end(), [&](const auto& b) { return b.name == name; });
      ASSERT_NE(found, all.end()) << name;
      EXPECT_LE(found->relative_error, bound) << name;
    }
  }
  void sweep_viscosity(const std::vector<std::string>& set) const {
    for (const char* viscosity : {"1e-5", "1e-3", "0.1", "10"}) {
      std::vector<std::string> one = set;
      one.push_back(std::string("Air/Dynamic viscosity=") + viscosity);
      expect_balanced(one);
    }
  }
};

TEST_F(Conservation, AnyDragStrength) {
  sweep_viscosity({"Air/Linear solver/Momentum preconditioner=ilu"});
}

TEST_F(Conservation, AnyDragStrengthLiteralModel) {
  sweep_viscosity(literal_model);
}

TEST_F(Conservation, ModelBAndTheOtherBackend) {
  sweep_viscosity({"Air/Formulation=B", "Air/Linear solver/Backend=petsc",
                   "Air/Linear solver/Momentum preconditioner=ilu"});
}

TEST_F(Conservation, BuoyancyVolumesAndEffects) {
  for (const char* volume : {"sub-spheres", "none"})
    expect_balanced({std::string("Coupling/Buoyancy volume=") + volume});
  expect_balanced({"Effects/Added mass/Strength=1", "Effects/History force/Strength=1", "Air/Formulation=B"});
}

TEST_F(Conservation, ThroughOpenSides) {
  expect_balanced(
      {"Air/Boundary conditions=bottom: velocity inlet, 0, 0, 0.05; top: pressure outlet, 0; *: slip"});
}

// A seed that lands: what the floor takes is booked, too.
TEST_F(Conservation, WithContactAtTheFloor) {
  expect_balanced({"Seeds/Position=11 mm, 13 mm, 2.05 mm", "Seeds/Velocity=0, 0, -0.1 m/s"});
  EXPECT_GT(read_series(out() / "seeds.csv")["velocity z"].back(), 0.05);  // it bounced
}

}  // namespace
}  // namespace seedflow
