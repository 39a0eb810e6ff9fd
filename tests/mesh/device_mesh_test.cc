#include "seedflow/mesh/device_mesh.h"

#include <gtest/gtest.h>

#include <sstream>

#include "seedflow/mesh/domain.h"
#include "seedflow/mesh/hole_plane.h"
#include "seedflow/mesh/refinement.h"

namespace seedflow {
namespace {

DeviceGeometry few_holes() {
  DeviceGeometry g;
  g.drilled = 3;
  return g;
}

DeviceMeshParameters coarse_sizes() {
  DeviceMeshParameters p;
  p.vacuum_cell = 2e-3;
  p.face_cell = 0.6e-3;
  p.growth = 2;
  return p;
}

std::map<std::string, double> areas(const DeviceMesh& mesh) {
  std::map<std::string, double> area;
  for (const auto& cell : mesh.coarse.active_cell_iterators())
    for (const unsigned int f : cell->face_indices())
      if (cell->face(f)->at_boundary())
        area[mesh.sides.at(cell->face(f)->boundary_id())] += cell->face(f)->measure();
  return area;
}

double volume(const DeviceMesh& mesh, dealii::types::material_id material) {
  double sum = 0;
  for (const auto& cell : mesh.coarse.active_cell_iterators())
    if (cell->material_id() == material) sum += cell->measure();
  return sum;
}

TEST(GradedLayers, fillTheLengthAndGrowAsAsked) {
  const auto ends = graded_layers(10, 0.5, 1.5, 2);
  EXPECT_EQ(ends.back(), 10);
  double before = 0, width = 0;
  for (const double end : ends) {
    if (width > 0) {
      EXPECT_LT((end - before) / width, 1.5 + 1e-12);
    }
    width = end - before;
    before = end;
    EXPECT_GT(width, 0.4);
    EXPECT_LT(width, 2.5);  // stretched by less than a layer
  }
  EXPECT_EQ(graded_layers(1, 5, 2, 9), std::vector<double>{1.0});
}

TEST(DeviceMesh, volumesAndSidesAreThoseOfTheGeometry) {
  const DeviceGeometry g = few_holes();
  const DeviceMesh mesh(g, coarse_sizes());
  auto area = areas(mesh);
  // Holes are polygons with the area of the circle: exact. Chamber walls are chords of at most 4 mm: 1 - c^2
  // with c = 4/98/sqrt(24) = 0.8 % is safe.
  const double r = g.hole_radius(), R = r + g.chamfer;
  const double front = M_PI * (g.chamber_outer_radius * g.chamber_outer_radius -
                               g.chamber_inner_radius * g.chamber_inner_radius);
  EXPECT_NEAR(area["hole end"], 3 * M_PI * r * r, 1e-12 * front);
  EXPECT_NEAR(area["ambient"] - area["disc"], 3 * M_PI * R * R, 1e-12 * front);
  EXPECT_NEAR(area["ambient"], front, 1e-3 * front);
  EXPECT_LE(area["ambient"], front) << "chords lie within the circle";
  const double holes =
      3 * M_PI * (r * r * (g.thickness - g.chamfer) + g.chamfer * (R * R + R * r + r * r) / 3);
  EXPECT_NEAR(volume(mesh, DeviceMesh::turning), area["ambient"] * g.chamber_depth + holes, 1e-4 * holes);
  const double back =
      0.5 * (g.vacuum_to - g.vacuum_from) *
      (g.vacuum_outer_radius * g.vacuum_outer_radius - g.vacuum_inner_radius * g.vacuum_inner_radius);
  EXPECT_NEAR(area["vacuum face"], back, 1e-3 * back);
  EXPECT_NEAR(area["suction"], area["vacuum face"], 1e-12);
  EXPECT_NEAR(volume(mesh, DeviceMesh::standing), area["vacuum face"] * g.vacuum_depth, 1e-12 * back);
  EXPECT_EQ(area.size(), 8u);
}

TEST(DeviceMesh, cellsAreConvexEnoughAndHolesAreWhereTheGeometryPutsThem) {
  DeviceGeometry g;  // all 60 holes
  g.first_angle = 0.3;
  DeviceMeshParameters p = coarse_sizes();
  const DeviceMesh mesh(g, p);
  std::vector<int> ends(g.holes, 0);
  for (const auto& cell : mesh.coarse.active_cell_iterators()) {
    // Smallest over largest determinant at the vertices: 1 for a parallelepiped, <= 0 if folded.
    double low = 1e300, high = -1e300;
    for (const unsigned int v : cell->vertex_indices()) {
      dealii::Tensor<2, 3> edges;
      for (int d = 0; d < 3; ++d) {
        const unsigned int w = v ^ (1u << d);
        edges[d] = (v < w ? 1.0 : -1.0) * (cell->vertex(w) - cell->vertex(v));
      }
      const double det = determinant(edges);
      low = std::min(low, det);
      high = std::max(high, det);
    }
    EXPECT_GT(low, 0.15 * high) << cell->center();
    for (const unsigned int f : cell->face_indices())
      if (cell->face(f)->at_boundary() && mesh.sides.at(cell->face(f)->boundary_id()) == "hole end")
        for (int k = 0; k < g.holes; ++k) {
          const Vec3 c = g.hole_centre(k, 0);
          if (cell->face(f)->center().distance({c.x, c.y, g.thickness}) < g.hole_radius()) ++ends[k];
        }
  }
  // A core of 4 x 4 cells and two rings of 16.
  for (const int n : ends) EXPECT_EQ(n, 48);
}

TEST(DeviceMesh, aSharpEdgedDiscHasNoChamferLayer) {
  DeviceGeometry g = few_holes();
  g.chamfer = 0;
  const DeviceMesh mesh(g, coarse_sizes());
  auto area = areas(mesh);
  EXPECT_NEAR(area["ambient"] - area["disc"], area["hole end"], 1e-15);
}

TEST(DeviceMeshMpi, isADomainThatCanBeRefined) {
  const DeviceMesh mesh(few_holes(), coarse_sizes());
  Domain<3> domain(mesh.coarse, mesh.sides, {}, MPI_COMM_WORLD);
  const double before = domain.volume();
  const auto cells = domain.triangulation().n_global_active_cells();
  for (const auto& cell : domain.triangulation().active_cell_iterators())
    if (cell->is_locally_owned() && cell->center()[2] > 0) cell->set_refine_flag();
  domain.triangulation().execute_coarsening_and_refinement();
  EXPECT_GT(domain.triangulation().n_global_active_cells(), 2 * cells);
  EXPECT_NEAR(domain.volume(), before, 1e-12 * before) << "straight edges: refinement keeps the shape";
}

TEST(DeviceMeshMpi, holesThatFaceTheVacuumAreFineAndNoOthers) {
  DeviceGeometry g = few_holes();
  g.vacuum_from = -0.5 * g.pitch_angle();  // the first hole only
  g.vacuum_to = 0.5 * g.pitch_angle();
  Domain<3> domain = device_domain(g, coarse_sizes(), MPI_COMM_WORLD);
  RefinementParameters p;
  p.max_level = 1;
  p.hole_distance = g.hole_radius();
  QuadratureLayout<3> layout;
  layout.n_q = 8;
  const auto adapt = [&](double turned) {
    std::vector<dealii::Point<3>> holes;
    for (const Vec3& x : g.sucking_holes(turned)) holes.push_back({x.x, x.y, x.z});
    domain.turn_to(turned);
    if (!flag_cells(p, domain, layout, {}, {}, {}, holes)) return false;
    domain.turn_to(0);
    domain.triangulation().execute_coarsening_and_refinement();
    domain.turn_to(turned);
    return true;
  };
  /// Levels of the cells around the end of hole k.
  const auto level = [&](int k, double turned) {
    const Vec3 c = g.hole_centre(k, turned);
    int highest = 0;
    for (const auto& cell : domain.triangulation().active_cell_iterators())
      if (cell->is_locally_owned() && cell->material_id() == DeviceMesh::turning &&
          cell->center().distance({c.x, c.y, g.thickness}) < g.hole_radius())
        highest = std::max(highest, cell->level());
    return dealii::Utilities::MPI::max(highest, MPI_COMM_WORLD);
  };
  adapt(0);
  EXPECT_EQ(level(0, 0), 1);
  EXPECT_EQ(level(1, 0), 0);
  EXPECT_EQ(level(2, 0), 0);
  const double turned = -2 * g.pitch_angle();  // now the third hole is where the first one was
  adapt(turned);
  EXPECT_EQ(level(0, turned), 0) << "coarse again";
  EXPECT_EQ(level(2, turned), 1);
}

}  // namespace
}  // namespace seedflow
