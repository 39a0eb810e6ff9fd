// A handful of spheres in a small drum: repetitions with other random numbers scatter, and that is
// uncertainty.
#include <gtest/gtest.h>

#include <cmath>

#include "falling_seed.h"
#include "seedflow/diagnose/observable_model.h"

namespace seedflow {
namespace {

Problem small_drum() {
  Problem p;
  p.prm = testing::write(testing::scratch("drum") / "model.prm", R"(set Experiment = rotating drum
subsection Run
  set Series interval = 20 ms
  set Field interval = 0
end
subsection Seeds
  set Diameter = 4 mm
  set Density = 1300
  set Sub-spheres = 1
end
subsection Materials
  set Shear modulus factor = 0.002
end
subsection Seeds motion
  set Time step = 2e-5 s
end
subsection Filling
  set Mass = 1 g
  set Rest energy = 1e-6 J
end
subsection Drum
  set Radius = 13 mm
  set Length = 10 mm
  set Speed = 60 rpm
  set Revolutions = 0.2
  set Diaphragm = false
  set Pictures at = 5
  set Plateau from = 0.1
end
)");
  for (const char* rpm : {"60", "90"}) {
    p.conditions.push_back({rpm, false, {std::string("Drum/Speed=") + rpm + " rpm"}});
    Measurement m;
    m.condition = rpm, m.quantity = "centre of mass angle", m.unit = "deg", m.coordinate = std::nan("");
    m.value = 30, m.standard_uncertainty = 0.1;
    p.measurements.push_back(m);
  }
  p.candidates = {{"Rolling friction", {{"Effects/Rolling friction/Strength", 0, 1}}}};
  p.budget.repeats = 3;
  return p;
}

TEST(Scatter, OfRepetitionsAddsToTheUncertainty) {
  const Problem p = small_drum();
  RunStore store;
  ObservableModel model(p, store);
  const Eigen::VectorXd mean = model.predict({});
  EXPECT_EQ(store.computed(), 6);  // two conditions, three repeats
  const auto error = model.add_scatter({{}});
  EXPECT_EQ(store.computed(), 6);
  ASSERT_EQ(error.count("centre of mass angle"), 1u);
  const auto [low, high] = error.at("centre of mass angle");
  EXPECT_GT(low, 1e-4);  // chaotic, but not without bounds
  EXPECT_LT(high, 0.5);
  const double stated = 0.1 * M_PI / 180;
  double least = 1, most = 0;
  for (const DataPoint& point : model.points())
    least = std::min(least, point.sigma), most = std::max(most, point.sigma);
  EXPECT_NEAR(least, std::hypot(stated, low), 1e-12);
  EXPECT_NEAR(most, std::hypot(stated, high), 1e-12);
  // Four degrees of freedom of the mean variance beside the two of a condition's own three runs: at most
  // (4 + 2 x 2)/(4 + 0) between the two conditions.
  EXPECT_LE(high * high, 2 * low * low * (1 + 1e-12));
  for (Eigen::Index i = 0; i < mean.size(); ++i) EXPECT_GT(mean[i], 0);  // the bed is carried up
}

}  // namespace
}  // namespace seedflow
