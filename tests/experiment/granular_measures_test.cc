// What is read off pictures of seeds, against made-up heaps, beds and mixtures whose answer is known.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "seedflow/base/error.h"
#include "seedflow/experiment/bed_contour.h"
#include "seedflow/experiment/heap_angle.h"
#include "seedflow/experiment/lacey_index.h"
#include "seedflow/experiment/seed_picture.h"

namespace seedflow {
namespace {

constexpr double degree = M_PI / 180;

// ---- Levenberg-Marquardt ----

TEST(CurveFitTest, NonLinearCurveIsRecovered) {
  std::vector<double> x, y;
  for (int i = 0; i < 40; ++i) x.push_back(0.1 * i), y.push_back(3 * std::exp(-0.8 * x.back()) + 0.5);
  const CurveFit fit =
      fit_curve([](double at, const std::vector<double>& p) { return p[0] * std::exp(p[1] * at) + p[2]; },
                {1, -0.1, 0}, x, y);
  EXPECT_NEAR(fit.parameters[0], 3, 1e-6);
  EXPECT_NEAR(fit.parameters[1], -0.8, 1e-6);
  EXPECT_NEAR(fit.parameters[2], 0.5, 1e-6);
  EXPECT_LT(fit.rms, 1e-7);
}

// For a straight line the least-squares answer and its standard error are closed forms.
TEST(CurveFitTest, LineIsTheClosedFormOfLeastSquares) {
  const std::vector<double> x = {0, 1, 2, 3, 4}, y = {1.0, 2.9, 5.2, 6.8, 9.3};
  double sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (int i = 0; i < 5; ++i) sx += x[i], sy += y[i], sxx += x[i] * x[i], sxy += x[i] * y[i];
  const double slope = (5 * sxy - sx * sy) / (5 * sxx - sx * sx), offset = (sy - slope * sx) / 5;
  double residual = 0;
  for (int i = 0; i < 5; ++i) residual += std::pow(y[i] - offset - slope * x[i], 2);
  const CurveFit fit = fit_line(x, y);
  EXPECT_NEAR(fit.parameters[1], slope, 1e-7);
  EXPECT_NEAR(fit.parameters[0], offset, 1e-7);
  EXPECT_NEAR(fit.standard_error[1], std::sqrt(residual / 3 / (sxx - sx * sx / 5)), 1e-6);
}

TEST(CurveFitTest, TooFewOrBadPoints) {
  EXPECT_THROW(fit_cubic({0, 1, 2}, {0, 1, 2}), RunError);
  EXPECT_THROW(fit_line({0, 1, NAN}, {0, 1, 2}), RunError);
}

// ---- Pictures ----

TEST(ViewTest, DiscCoversItsArea) {
  Silhouette picture({0, 0, 10e-3, 10e-3}, 0.05e-3);
  picture.add({5e-3, 5e-3, 0, 3e-3});
  // Pixels along the rim are in or out: error about rim/pixel/area, 0.1 %.
  EXPECT_NEAR(picture.filled_share(), M_PI * 9 / 100, 1e-3);
  const Silhouette::Boundary edge = picture.upper_boundary();
  ASSERT_FALSE(edge.x.empty());
  for (std::size_t i = 0; i < edge.x.size(); ++i)
    EXPECT_NEAR(edge.y[i], 5e-3 + std::sqrt(std::max(0.0, 9e-6 - std::pow(edge.x[i] - 5e-3, 2))), 0.05e-3);
}

TEST(ViewTest, NearSeedsHideFarOnes) {
  // A ball fully behind another, one half covered (by a lens of known area), one free.
  const std::vector<Disc> discs = {{0, 0, 0, 1}, {0, 0, 5, 1}, {10, 0, 0, 1}, {11, 0, 5, 1}};
  const std::vector<double> share = visible_shares(discs, 0.01);
  EXPECT_EQ(share[0], 0);
  EXPECT_EQ(share[1], 1);
  EXPECT_EQ(share[3], 1);
  const double lens = 2 * std::acos(0.5) - 0.5 * std::sqrt(3.0);  // two unit circles, distance 1
  EXPECT_NEAR(share[2], 1 - lens / M_PI, 5e-3);
}

TEST(ViewTest, CameraAxes) {
  const View from_above{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const std::vector<Disc> discs = seen_from(from_above, {{1, 2, 3}}, {0.5});
  EXPECT_EQ(discs[0].x, 1);
  EXPECT_EQ(discs[0].y, 2);
  EXPECT_EQ(discs[0].depth, 3);
  EXPECT_THROW(Silhouette({0, 0, 0, 1}, 0.1), RunError);
  EXPECT_THROW(Silhouette({0, 0, 1e6, 1e6}, 0.1), RunError);
}

// ---- Angle of repose ----

/// The boundary of a triangle with the given slopes, its top at x = 0, 40 mm high, with noise.
Silhouette::Boundary heap_boundary(double left, double right, double noise, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0, 1);
  Silhouette::Boundary b;
  const double height = 40e-3;
  for (double x = -0.12; x < 0.12; x += 0.1e-3) {
    const double y = height - std::tan(x < 0 ? left : right) * std::abs(x);
    b.x.push_back(x);
    b.y.push_back(std::max(0.0, y + noise * normal(random)));
  }
  return b;
}

TEST(HeapAngleTest, KnownSlopesToThePixel) {
  const HeapAngle heap = heap_angle(heap_boundary(25 * degree, 31 * degree, 0, 1), 0, {});
  EXPECT_NEAR(heap.left.angle / degree, 25, 0.01);
  EXPECT_NEAR(heap.right.angle / degree, 31, 0.01);
  EXPECT_NEAR(heap.mean / degree, 28, 0.01);
  EXPECT_NEAR(heap.height, 40e-3, 1e-3);  // the running mean rounds the tip by a quarter of its width x slope
  EXPECT_NEAR(heap.top, 0, 2e-3);
}

// With noise of a fifth of a seed the mean over many heaps is the slope within its statistical error: the
// choice of the fitted part does not bias it.
TEST(HeapAngleTest, NoiseDoesNotBiasTheAngle) {
  double sum = 0, square = 0;
  const int n = 60;
  for (int k = 0; k < n; ++k) {
    const double angle = heap_angle(heap_boundary(28.8 * degree, 28.8 * degree, 0.8e-3, 7 + k), 0, {}).mean;
    sum += angle / degree, square += angle / degree * (angle / degree);
  }
  const double mean = sum / n, deviation = std::sqrt((square / n - mean * mean) / (n - 1.0));
  EXPECT_NEAR(mean, 28.8, 4 * deviation);
  EXPECT_LT(deviation, 0.02);
}

// A heap of balls: a slanted row of balls of diameter d, their tops all on a line. The boundary of balls that
// touch along the slope lies below the tangent line by at most d/2 (1 - cos 30 deg); its slope is the same.
TEST(HeapAngleTest, HeapOfBalls) {
  const double d = 4e-3, angle = 28.8 * degree;
  std::vector<Disc> discs;
  for (int side = -1; side <= 1; side += 2)
    for (double s = 0; s < 80e-3; s += 0.5 * d)
      for (double down = 0; down < 30e-3; down += d) {
        const double x = side * s * std::cos(angle), y = 40e-3 - s * std::sin(angle) - down;
        if (y > d / 2) discs.push_back({x, y, 0, d / 2});
      }
  const HeapAngle heap = heap_angle(discs, 0, {});
  // Half-diameter spacing leaves ripples of d/2 (1 - cos 14.5 deg) = 0.06 mm; over 50 mm that is 0.1 degrees.
  EXPECT_NEAR(heap.left.angle / degree, 28.8, 0.2);
  EXPECT_NEAR(heap.right.angle / degree, 28.8, 0.2);
  EXPECT_NEAR(heap.left.angle, heap.right.angle, 1e-3);  // mirror images up to the raster
}

// Seeds that rolled away from the heap and a flattened toe are not part of the flank.
TEST(HeapAngleTest, StragglersAndToeAreLeftOut) {
  Silhouette::Boundary b = heap_boundary(28 * degree, 28 * degree, 0, 1);
  for (std::size_t i = 0; i < b.x.size(); ++i)
    if (std::abs(b.x[i]) > 0.09 && std::abs(b.x[i]) < 0.094) b.y[i] = 4e-3;
  EXPECT_NEAR(heap_angle(b, 0, {}).mean / degree, 28, 0.01);
}

// A layer one seed high around a low heap is not its flank: followed, it flattens the line, which then
// reaches further.
TEST(HeapAngleTest, LayerAtTheFootIsNoFlank) {
  Silhouette::Boundary b = heap_boundary(22 * degree, 22 * degree, 0, 1);
  for (double& y : b.y) y = std::max(y - 24e-3, 4e-3);
  HeapAngleSettings settings;
  settings.layer = 4.2e-3;
  EXPECT_NEAR(heap_angle(b, 0, settings).mean / degree, 22, 0.01);
  settings.layer = 0;
  EXPECT_LT(heap_angle(b, 0, settings).mean / degree, 20);
}

TEST(HeapAngleTest, NoHeap) {
  Silhouette::Boundary flat;
  for (int i = 0; i < 1000; ++i) flat.x.push_back(1e-4 * i), flat.y.push_back(4e-3);
  EXPECT_THROW(heap_angle(flat, 0, {}), RunError);
  EXPECT_THROW(heap_angle(Silhouette::Boundary(), 0, {}), RunError);
}

// ---- Lacey ----

TEST(LaceyTest, SegregatedIsZero) {
  const LaceyIndex lacey = lacey_index({{10, 10}, {20, 0}, {10, 10}, {0, 0}});
  EXPECT_NEAR(lacey.index, 0, 1e-15);
  EXPECT_EQ(lacey.n_cells, 3);
  EXPECT_NEAR(lacey.segregated, 0.25, 1e-15);
}

TEST(LaceyTest, ClosedForm) {
  // p = 10/20; S^2 = 1/4 (1 - 0.5)^2 + 3/4 (1/3 - 1/2)^2; N = 10.
  const LaceyIndex lacey = lacey_index({{5, 5}, {15, 5}});
  const double s2 = 0.25 * 0.25 + 0.75 / 36;
  EXPECT_NEAR(lacey.variance, s2, 1e-15);
  EXPECT_NEAR(lacey.mixed, 0.025, 1e-15);
  EXPECT_NEAR(lacey.index, (0.25 - s2) / (0.25 - 0.025), 1e-15);
  // Every cell has the overall share: better than random, above one.
  EXPECT_NEAR(lacey_index({{4, 2}, {8, 4}}).index, 0.25 / (0.25 - 0.25 / 6), 1e-15);
}

// Sub-spheres counted instead of seeds: cells that hold n whole seeds of k each have the same S^2, but Sr^2
// is that of k n independent things, so a mixture that is random by seeds (index 1) stays below 1.
TEST(LaceyTest, CountedBySubSpheresARandomMixtureStaysBelowOne) {
  const int k = 7;
  // Four cells of two seeds: two mixed, one of each colour: S^2 = p (1 - p)/2, random by seeds.
  std::vector<Vec3> seeds, sub_spheres;
  std::vector<bool> seeds_coloured, sub_spheres_coloured;
  const bool colour[4][2] = {{true, false}, {true, false}, {true, true}, {false, false}};
  for (int cell = 0; cell < 4; ++cell)
    for (int s = 0; s < 2; ++s)
      for (int i = 0; i < k; ++i) {
        const Vec3 at{cell + 0.4, 0.3 + 0.4 * s, 0.1 * i};
        sub_spheres.push_back(at);
        sub_spheres_coloured.push_back(colour[cell][s]);
        if (i) continue;
        seeds.push_back(at);
        seeds_coloured.push_back(colour[cell][s]);
      }
  EXPECT_NEAR(lacey_index(mixing_cells(seeds, seeds_coloured, {1, 1, 1})).index, 1, 1e-14);
  EXPECT_NEAR(lacey_index(mixing_cells(sub_spheres, sub_spheres_coloured, {1, 1, 1})).index,
              (1 - 1.0 / 2) / (1 - 1.0 / (2 * k)), 1e-14);
}

// Random mixtures with unequal cells: mean 1 within the statistical error, scatter as predicted.
TEST(LaceyTest, RandomIsOneWhateverTheCellsHold) {
  std::mt19937 random(3);
  const int n = 400;
  double sum = 0, square = 0, predicted = 0;
  for (int k = 0; k < n; ++k) {
    std::vector<MixingCell> cells;
    for (int i = 0; i < 300; ++i) {
      MixingCell cell{1 + i % 9, 0};
      for (int s = 0; s < cell.seeds; ++s) cell.coloured += random() % 2;
      cells.push_back(cell);
    }
    const LaceyIndex lacey = lacey_index(cells);
    sum += lacey.index, square += lacey.index * lacey.index, predicted = lacey.random_scatter;
  }
  const double mean = sum / n, deviation = std::sqrt(square / n - mean * mean);
  // p is estimated from the same seeds: the mean is 1 + about 1/1500 (one degree of freedom of 1500 seeds).
  EXPECT_NEAR(mean, 1, 4 * deviation / std::sqrt(n) + 1e-3);
  EXPECT_NEAR(deviation, predicted, 0.15 * predicted);  // 4 standard errors of a standard deviation of 400
}

TEST(LaceyTest, CellsOfPositions) {
  std::vector<Vec3> centres;
  std::vector<bool> red;
  for (int i = 0; i < 10; ++i)
    for (int j = 0; j < 10; ++j)
      for (int k = 0; k < 4; ++k) {
        centres.push_back({1e-3 * (i - 4.5), 1e-3 * j, 1e-3 * k});
        red.push_back(i < 5);
      }
  // Cells of 5 mm from the origin separate the colours exactly; through the depth there is one layer of
  // cells.
  const std::vector<MixingCell> flat = mixing_cells(centres, red, {5e-3, 5e-3, 0});
  EXPECT_EQ(flat.size(), 4u);
  for (const MixingCell& cell : flat) EXPECT_EQ(cell.seeds, 100);
  EXPECT_NEAR(lacey_index(flat).index, 0, 1e-15);
  EXPECT_EQ(mixing_cells(centres, red, {5e-3, 5e-3, 2e-3}).size(), 8u);
}

TEST(LaceyTest, NothingToMix) {
  EXPECT_THROW(lacey_index({{10, 10}, {4, 4}}), RunError);
  EXPECT_THROW(lacey_index({}), RunError);
  EXPECT_THROW(lacey_index({{1, 1}, {1, 0}}), RunError);
}

// ---- The bed of a drum ----

Silhouette::Boundary bed(double a, double s, double curl) {
  Silhouette::Boundary b;
  for (double x = -50e-3; x <= 50e-3; x += 0.1e-3) {
    const double surface = a + s * x + curl * x * x * x, wall = std::sqrt(std::max(0.0, 25e-4 - x * x));
    if (surface > -wall) b.x.push_back(x), b.y.push_back(std::min(surface, wall));
  }
  return b;
}

TEST(BedContourTest, StraightSurface) {
  const BedContour contour = bed_contour(bed(-10e-3, std::tan(30 * degree), 0), 0, 0, 50e-3, 0.5e-3, {});
  EXPECT_NEAR(contour.angle / degree, 30, 1e-3);
  EXPECT_NEAR(contour.middle_angle / degree, 30, 1e-2);
  EXPECT_NEAR(contour.surface(0), -10e-3, 1e-6);
}

TEST(BedContourTest, CurvedSurface) {
  // Steep at the top, flat at the bottom: y = -8 mm + 0.6 x - 50 x^3 (1/m^2).
  const BedContour contour = bed_contour(bed(-8e-3, 0.6, -50), 0, 0, 50e-3, 0.5e-3, {});
  for (const double x : {-20e-3, 0.0, 15e-3})
    EXPECT_NEAR(contour.surface(x), -8e-3 + 0.6 * x - 50 * x * x * x, 2e-6);
  EXPECT_LT(contour.angle, contour.middle_angle);
}

TEST(BedContourTest, EmptyDrum) {
  EXPECT_THROW(bed_contour(Silhouette::Boundary(), 0, 0, 50e-3, 0.5e-3, {}), RunError);
}

// ---- Drawings ----

TEST(SeedPictureTest, NearSeedsAreDrawnLast) {
  SeedPicture picture{"two seeds", {-5e-3, -5e-3, 5e-3, 5e-3}};
  picture.discs = {{0, 0, 2e-3, 2e-3}, {1e-3, 0, 0, 2e-3}, {0.1e-3, 0, -9e-3, 1e-3}};
  picture.group = {0, 1, 2};
  const std::string svg = picture.svg();
  // Red (group 0) is nearer than blue (group 1) and therefore comes later; the hidden third is not drawn.
  const auto circles = [&](const std::string& part) {
    int n = 0;
    for (std::size_t at = svg.find(part); at != std::string::npos; at = svg.find(part, at + 1)) ++n;
    return n;
  };
  EXPECT_EQ(circles("<circle"), 6);
  EXPECT_LT(svg.find("cx=\"312\""), svg.find("cx=\"260\""));
  EXPECT_NE(svg.find("two seeds"), std::string::npos);
  EXPECT_NE(svg.find("20 mm"), std::string::npos);
}

}  // namespace
}  // namespace seedflow
