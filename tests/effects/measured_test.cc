// The catalogue against measurements. The coefficients are the published ones; nothing is fitted here.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "places.h"
#include "seedflow/effects/drag_laws.h"
#include "seedflow/effects/single_body.h"

namespace seedflow {
namespace {

std::vector<std::vector<double>> read_table(const std::string& name) {
  std::ifstream in(std::string(places::source_dir) + "/tests/effects/" + name);
  std::vector<std::vector<double>> rows;
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || !std::isdigit(static_cast<unsigned char>(line[0]))) continue;
    rows.emplace_back();
    std::istringstream fields(line);
    for (std::string field; std::getline(fields, field, ',');) rows.back().push_back(std::stod(field));
  }
  return rows;
}

TEST(Measured, SchillerNaumannInTheScatterOfSphereDrag) {
  const auto rows = read_table("brown_lawler_2003.csv");
  ASSERT_EQ(rows.size(), 319u);
  const double band[5] = {0, 0.5, 10, 100, 1000};
  for (int b = 0; b < 4; ++b) {
    double sum = 0, n = 0;
    for (const auto& row : rows)
      if (row[0] >= band[b] && row[0] < band[b + 1])
        sum += std::pow(std::log(row[1] / drag_coefficient(drag_law("Schiller-Naumann"), row[0])), 2), ++n;
    ASSERT_GT(n, 30);
    EXPECT_LT(std::sqrt(sum / n), 0.06) << band[b];  // measured 3.4, 4.7, 4.7, 5.5 %
  }
}

struct Settling {
  double diameter, density_ratio, terminal;  // terminal: measured [m/s]
};
constexpr Settling mordant_1 = {0.5e-3, 2.56, 0.0741}, mordant_2 = {1.5e-3, 2.56, 0.218},
                   mordant_4 = {0.8e-3, 7.71, 0.316};

/// Root mean square of simulated - measured speed over the measured terminal speed. Rows: time, speed.
double misfit(const Settling& c, const std::vector<std::array<double, 2>>& rows, bool added_mass,
              bool history) {
  PrescribedFlow water;
  water.viscosity = 0.9e-3;  // implied by the published Re = V d/nu of all three cases
  EffectSet set;
  set["Added mass"].set_strength(added_mass);
  set["History force"].set_strength(history);
  SingleBody sphere({c.diameter, 1000 * c.density_ratio, 1}, water, set);
  std::vector<double> times;
  for (const auto& row : rows) times.push_back(row[0]);
  const auto series = sphere.run(times, 5e-4);
  double sum = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) sum += std::pow(-series[i].velocity.z - rows[i][1], 2);
  return std::sqrt(sum / rows.size()) / c.terminal;
}

std::vector<std::array<double, 2>> mordant(int number) {
  std::vector<std::array<double, 2>> rows;
  for (const auto& row : read_table("mordant_pinton_2000.csv"))
    if (row[0] == number) rows.push_back({row[1], row[2]});
  return rows;
}

TEST(Measured, AddedMassAndHistoryExplainTheStartFromRest) {
  // Case 4, Re 280: 4.9 % quasi-steady, 3.6 % with added mass, 1.2 % with both.
  const auto four = mordant(4);
  ASSERT_GT(four.size(), 55u);
  const double quasi_steady = misfit(mordant_4, four, false, false),
               mass = misfit(mordant_4, four, true, false), both = misfit(mordant_4, four, true, true);
  EXPECT_GT(quasi_steady, 0.045);
  EXPECT_LT(mass, 0.8 * quasi_steady);
  EXPECT_LT(both, 0.02);
  // Case 1, Re 41: 15.3, 12.2 and 6.7 %. What is left is the steady level, 6 % too fast: the drag measured
  // there is 8 % above Schiller-Naumann, which is more than the scatter above and would be 2.6 % in the
  // diameter.
  const auto one = mordant(1);
  ASSERT_GT(one.size(), 55u);
  EXPECT_GT(misfit(mordant_1, one, false, false), 0.14);
  EXPECT_LT(misfit(mordant_1, one, true, true), 0.075);
  // Case 2, Re 360, is known here by the authors' fit V (1 - exp(-3 t/t95)) alone: 5.9 % quasi-steady, 1.3 %
  // with both.
  std::vector<std::array<double, 2>> two;
  for (int i = 1; i <= 200; ++i) two.push_back({4e-3 * i, 0.218 * -std::expm1(-3 * 4e-3 * i / 0.142)});
  EXPECT_GT(misfit(mordant_2, two, false, false), 0.05);
  EXPECT_LT(misfit(mordant_2, two, true, true), 0.02);
}

TEST(Measured, TankOfTenCateIsNeitherOpenNorALongTube) {
  // ten Cate, Nieuwstad, Derksen & Van den Akker (2002), Phys. Fluids 14, 4012, doi:10.1063/1.1512918: 15 mm
  // sphere, 1120 kg/m3, tank 100 x 100 x 160 mm. Density, viscosity, measured peak speed (digitised, +- 1e-3
  // m/s).
  const double cases[4][3] = {
      {970, 0.373, 0.0370}, {965, 0.212, 0.0595}, {962, 0.113, 0.0870}, {960, 0.058, 0.1233}};
  for (const auto& [density, viscosity, measured] : cases) {
    const auto peak = [&, density = density, viscosity = viscosity](double tube) {
      PrescribedFlow oil;
      oil.density = density, oil.viscosity = viscosity, oil.tube_diameter = tube;
      EffectSet set;
      set["Added mass"].set_strength(1), set["History force"].set_strength(1);
      set["Tube wall drag"].set_strength(tube < 1 ? 1 : 0);
      SingleBody sphere({0.015, 1120, 1}, oil, set);
      double fastest = 0;
      while (sphere.state().position.z > -0.12) {
        sphere.step(2e-3);
        fastest = std::max(fastest, norm(sphere.state().velocity));
      }
      return fastest;
    };
    // Open fluid overshoots by 3 to 10 %; the wall factor of a long tube of equal section undershoots by 10
    // to 18 %. A tank 1.6 widths deep is neither: it has to be resolved.
    EXPECT_GT(measured / peak(1e300), 0.89) << viscosity;
    EXPECT_LT(measured / peak(1e300), 0.98) << viscosity;
    EXPECT_GT(measured / peak(0.1128), 1.08) << viscosity;
    EXPECT_LT(measured / peak(0.1128), 1.25) << viscosity;
  }
}

}  // namespace
}  // namespace seedflow
