#include "seedflow/coupling/point_exchange.h"

#include <gtest/gtest.h>

#include <cmath>

#include "refined_box.h"
#include "seedflow/coupling/kernels.h"

namespace seedflow {
namespace {

using dealii::Tensor;

const std::vector<Vec3> centres = {
    {0.0150, 0.0150, 0.0300}, {0.0165, 0.0135, 0.0211}, {0.004, 0.0261, 0.0523}};

/// All kernels the coupling offers, by name.
struct Case {
  const char* name;
  void (*fill)(PointExchange&, const RefinedBox&, const Vec3&);
};
const Case cases[] = {
    {"cell", [](PointExchange& e, const RefinedBox& b,
                const Vec3& x) { add_cell_kernel(e, b.location, b.layout, x); }},
    {"sampled", [](PointExchange& e, const RefinedBox& b,
                   const Vec3& x) { add_sampled_kernel(e, b.location, b.layout, x, 0.002, 20); }},
    {"gaussian", [](PointExchange& e, const RefinedBox& b, const Vec3& x) {
       add_gaussian_kernel(e, b.location, b.layout, x, 0.004);
     }}};

PointExchange exchange_for(const RefinedBox& box, const Case& kernel) {
  PointExchange exchange(box.layout, MPI_COMM_WORLD);
  for (const Vec3& x : centres) {
    kernel.fill(exchange, box, x);
    exchange.next();
  }
  EXPECT_TRUE(exchange.normalize().empty());
  return exchange;
}

double integral(const std::vector<double>& density, const RefinedBox& box) {
  double sum = 0;
  for (std::size_t q = 0; q < density.size(); ++q) sum += density[q] * box.layout.JxW[q];
  return dealii::Utilities::MPI::sum(sum, MPI_COMM_WORLD);
}

TEST(PointExchangeMpi, depositsExactlyWhatItIsGiven) {
  RefinedBox box;
  for (const Case& kernel : cases) {
    const PointExchange exchange = exchange_for(box, kernel);
    std::vector<double> density(box.layout.size(), 0.0);
    exchange.deposit(std::vector<double>{1.0, 3.0, -0.5}, density);
    EXPECT_NEAR(integral(density, box), 3.5, 3.5e-12) << kernel.name;
  }
}

TEST(PointExchangeMpi, averageIsTheTransposeOfDeposit) {
  RefinedBox box;
  std::vector<Tensor<1, 3>> field(box.layout.size());
  for (std::size_t q = 0; q < field.size(); ++q)
    for (int d = 0; d < 3; ++d) field[q][d] = std::sin(300 * box.layout.position[q][d] + d) + 0.1 * d;
  for (const Case& kernel : cases) {
    const PointExchange exchange = exchange_for(box, kernel);
    const std::vector<Vec3> force = {{1, 2, 3}, {-1, 0.5, 0}, {0, 0, 4}};
    std::vector<Tensor<1, 3>> density(field.size());
    exchange.deposit(force, density);
    double power_on_air = 0;
    for (std::size_t q = 0; q < field.size(); ++q) power_on_air += density[q] * field[q] * box.layout.JxW[q];
    power_on_air = dealii::Utilities::MPI::sum(power_on_air, MPI_COMM_WORLD);
    const std::vector<Vec3> seen = exchange.average(field);
    double power_at_points = 0;
    for (std::size_t p = 0; p < seen.size(); ++p) power_at_points += dot(seen[p], force[p]);
    EXPECT_NEAR(power_on_air, power_at_points, 1e-12 * std::abs(power_at_points)) << kernel.name;
  }
}

TEST(PointExchangeMpi, averageOfAConstantIsTheConstant) {
  RefinedBox box;
  for (const Case& kernel : cases)
    for (const double value : exchange_for(box, kernel).average(std::vector<double>(box.layout.size(), 7.0)))
      EXPECT_NEAR(value, 7.0, 1e-13 * 7) << kernel.name;
}

TEST(PointExchangeMpi, sampledShareOfACellTendsToTheExactShare) {
  // A sphere of 2 mm radius centred on a face of the 3 mm mesh: half of it on each side.
  RefinedBox box;
  const Vec3 on_face{0.0045, 0.0045, 0.006};
  PointExchange exchange(box.layout, MPI_COMM_WORLD);
  add_sampled_kernel(exchange, box.location, box.layout, on_face, 0.002, 40);
  exchange.next();
  ASSERT_TRUE(exchange.normalize().empty());
  std::vector<double> below(box.layout.size());
  for (std::size_t q = 0; q < below.size(); ++q) below[q] = box.layout.position[q][2] < 0.006;
  EXPECT_NEAR(exchange.average(below)[0], 0.5, 1e-12);  // the lattice is symmetric about the centre
}

TEST(PointExchangeMpi, gaussianHasItsStandardDeviation) {
  // Second moment of the discrete kernel on 3 mm cells: sigma^2 per direction, to the 1e-3 that the cut-off
  // at 4.5 sigma (3e-4) and two-point quadrature leave.
  RefinedBox box;
  PointExchange exchange(box.layout, MPI_COMM_WORLD);
  const Vec3 centre{0.0153, 0.0147, 0.031};
  add_gaussian_kernel(exchange, box.location, box.layout, centre, 0.003);
  exchange.next();
  ASSERT_TRUE(exchange.normalize().empty());
  std::vector<double> moment(box.layout.size());
  for (std::size_t q = 0; q < moment.size(); ++q)
    moment[q] = std::pow(box.layout.position[q][2] - centre.z, 2);
  EXPECT_NEAR(exchange.average(moment)[0], 9e-6, 1e-3 * 9e-6);
}

TEST(PointExchangeMpi, aPointOutsideTheMeshIsNamed) {
  RefinedBox box;
  PointExchange exchange(box.layout, MPI_COMM_WORLD);
  for (const Vec3& x : {Vec3{0.01, 0.01, 0.01}, Vec3{0.01, 0.01, 0.09}}) {
    add_cell_kernel(exchange, box.location, box.layout, x);
    exchange.next();
  }
  EXPECT_EQ(exchange.normalize(), std::vector<long>{1});
}

}  // namespace
}  // namespace seedflow
