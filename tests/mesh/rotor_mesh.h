#pragma once

#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/manifold_lib.h>

#include <functional>

#include "seedflow/mesh/domain.h"

namespace seedflow {

/// Two meshes side by side as one, without merging vertices: the rotor's cells get material 1. `side` gives
/// the boundary id of a face by its centre and by whether it belongs to the rotor.
template <int dim>
void join(const dealii::Triangulation<dim>& rotor, const dealii::Triangulation<dim>& stator,
          const std::function<int(const dealii::Point<dim>&, bool)>& side,
          dealii::Triangulation<dim>& result) {
  std::vector<dealii::Point<dim>> vertices;
  std::vector<dealii::CellData<dim>> cells;
  for (const auto* mesh : {&rotor, &stator}) {
    const unsigned int offset = vertices.size();
    vertices.insert(vertices.end(), mesh->get_vertices().begin(), mesh->get_vertices().end());
    for (const auto& cell : mesh->active_cell_iterators()) {
      dealii::CellData<dim> data;
      for (const unsigned int v : cell->vertex_indices()) data.vertices[v] = offset + cell->vertex_index(v);
      data.material_id = mesh == &rotor ? 1 : 0;
      cells.push_back(data);
    }
  }
  dealii::SubCellData none;
  result.create_triangulation(vertices, cells, none);
  for (const auto& cell : result.active_cell_iterators())
    for (const unsigned int f : cell->face_indices())
      if (cell->face(f)->at_boundary())
        cell->face(f)->set_boundary_id(side(cell->face(f)->center(), cell->material_id() == 1));
}

/// 2D: an annulus r in [inner, middle] with `n_rotor` cells around turns within r in [middle, outer] with
/// `n_stator` cells; sides "inner", "outer", "rotor side", "stator side". All vertices of the coarse mesh lie
/// on circles, and refinement keeps them there.
inline std::unique_ptr<Domain<2>> ring(double inner, double middle, double outer, int n_rotor, int n_stator,
                                       int layers, int refinements, MPI_Comm comm = MPI_COMM_WORLD) {
  const auto shell = [](double a, double b, int around, int across, dealii::Triangulation<2>& mesh) {
    std::vector<dealii::Point<2>> x;
    std::vector<dealii::CellData<2>> cells;
    for (int i = 0; i < around; ++i)
      for (int k = 0; k <= across; ++k) {
        const double r = a + (b - a) * k / across, t = 2 * dealii::numbers::PI * i / around;
        x.emplace_back(r * std::cos(t), r * std::sin(t));
      }
    for (int i = 0; i < around; ++i)
      for (int k = 0; k < across; ++k) {
        const unsigned int here = i * (across + 1) + k, next = ((i + 1) % around) * (across + 1) + k;
        dealii::CellData<2> c;
        c.vertices = {here, here + 1, next, next + 1};
        cells.push_back(c);
      }
    mesh.create_triangulation(x, cells, dealii::SubCellData());
  };
  dealii::Triangulation<2> a, b, both;
  shell(inner, middle, n_rotor, layers, a);
  shell(middle, outer, n_stator, layers, b);
  join<2>(
      a, b,
      [=](const dealii::Point<2>& x, bool turns) {
        if (turns) return x.norm() < 0.5 * (inner + middle) ? 0 : 1;
        return x.norm() < 0.5 * (middle + outer) ? 2 : 3;
      },
      both);
  both.set_all_manifold_ids(0);
  both.set_manifold(0, dealii::PolarManifold<2>());
  auto domain =
      std::make_unique<Domain<2>>(both,
                                  std::map<dealii::types::boundary_id, std::string>{
                                      {0, "inner"}, {1, "rotor side"}, {2, "stator side"}, {3, "outer"}},
                                  std::vector<std::string>(), comm);
  domain->triangulation().refine_global(refinements);
  Rotor<2> rotor;
  rotor.pairs = {{"rotor side", "stator side"}};
  domain->set_rotor(rotor);
  return domain;
}

/// 3D: the same annuli with height 0.4 along z, `n_rotor`/8 and `n_stator`/8 cells high; the interface is a
/// cylinder. Sides "inner", "outer", "rotor side", "stator side", "ends".
inline std::unique_ptr<Domain<3>> tube(double inner, double middle, double outer, int n_rotor, int n_stator,
                                       int refinements, MPI_Comm comm = MPI_COMM_WORLD) {
  const double height = 0.4;
  const auto shell = [height](double a, double b, int around, dealii::Triangulation<3>& mesh) {
    std::vector<dealii::Point<3>> x;
    std::vector<dealii::CellData<3>> cells;
    const int up = around / 8;
    for (int k = 0; k <= up; ++k)
      for (int i = 0; i < around; ++i)
        for (const double r : {a, b}) {
          const double t = 2 * dealii::numbers::PI * i / around;
          x.emplace_back(r * std::cos(t), r * std::sin(t), height * k / up);
        }
    for (int k = 0; k < up; ++k)
      for (int i = 0; i < around; ++i) {
        dealii::CellData<3> c;
        for (int v = 0; v < 8; ++v)
          c.vertices[v] = ((k + (v >> 2)) * around + (i + (v >> 1 & 1)) % around) * 2 + (v & 1);
        cells.push_back(c);
      }
    mesh.create_triangulation(x, cells, dealii::SubCellData());
  };
  dealii::Triangulation<3> a, b, both;
  shell(inner, middle, n_rotor, a);
  shell(middle, outer, n_stator, b);
  join<3>(
      a, b,
      [=](const dealii::Point<3>& x, bool turns) {
        if (x[2] < 1e-9 || x[2] > height - 1e-9) return 4;
        const double r = std::hypot(x[0], x[1]);
        if (turns) return r < 0.5 * (inner + middle) ? 0 : 1;
        return r < 0.5 * (middle + outer) ? 2 : 3;
      },
      both);
  both.set_all_manifold_ids(0);
  both.set_manifold(0, dealii::CylindricalManifold<3>(2));
  auto domain = std::make_unique<Domain<3>>(
      both,
      std::map<dealii::types::boundary_id, std::string>{
          {0, "inner"}, {1, "rotor side"}, {2, "stator side"}, {3, "outer"}, {4, "ends"}},
      std::vector<std::string>(), comm);
  domain->triangulation().refine_global(refinements);
  Rotor<3> rotor;
  rotor.pairs = {{"rotor side", "stator side"}};
  domain->set_rotor(rotor);
  return domain;
}

/// 3D: a block over another, x in [-a, a]^2 each, meeting at z = 0 in cells of different size; the lower one,
/// of half-width `lower`, turns about z. Distorted by `bend` so that faces are general quadrilaterals.
/// Sides "rotor top", "stator bottom" (the interface), "rotor wall", "stator wall", "floor" (of the rotor),
/// "lid".
inline std::unique_ptr<Domain<3>> blocks(double lower, int n_lower, double upper, int n_upper, double bend,
                                         MPI_Comm comm = MPI_COMM_WORLD) {
  dealii::Triangulation<3> a, b, both;
  const auto block = [bend](double half, int n, double z0, double z1, dealii::Triangulation<3>& mesh) {
    dealii::GridGenerator::subdivided_hyper_rectangle(mesh, {unsigned(n), unsigned(n), unsigned(n)},
                                                      {-half, -half, z0}, {half, half, z1});
    dealii::GridTools::transform(
        [=](const dealii::Point<3>& x) {
          const double f = bend * (1 - x[0] * x[0] / (half * half)) * (1 - x[1] * x[1] / (half * half));
          return dealii::Point<3>(x[0] + half * f, x[1] - half * f, x[2]);
        },
        mesh);
  };
  block(lower, n_lower, -lower, 0, a);
  block(upper, n_upper, 0, upper, b);
  join<3>(
      a, b,
      [=](const dealii::Point<3>& x, bool turns) {
        if (std::abs(x[2] + lower) < 1e-12) return 4;
        if (std::abs(x[2] - upper) < 1e-12) return 5;
        return std::abs(x[2]) < 1e-12 ? (turns ? 1 : 2) : (turns ? 0 : 3);
      },
      both);
  auto domain =
      std::make_unique<Domain<3>>(both,
                                  std::map<dealii::types::boundary_id, std::string>{{0, "rotor wall"},
                                                                                    {1, "rotor top"},
                                                                                    {2, "stator bottom"},
                                                                                    {3, "stator wall"},
                                                                                    {4, "floor"},
                                                                                    {5, "lid"}},
                                  std::vector<std::string>(), comm);
  Rotor<3> rotor;
  rotor.pairs = {{"rotor top", "stator bottom"}};
  domain->set_rotor(rotor);
  return domain;
}

/// 3D: air over a disc in z = 0, between the radii `a` and `b`; what lies below the last of the heights
/// `below` turns, the rest, up to the last of `above`, stands. `n_below` and `n_above` cells around, `across`
/// from radius to radius. Sides "disc", "below" and "above" (both cylinders), "lid", "rotor top", "stator
/// bottom".
inline std::unique_ptr<Domain<3>> disc_and_air(double a, double b, int n_below, int n_above, int across,
                                               const std::vector<double>& below,
                                               const std::vector<double>& above,
                                               MPI_Comm comm = MPI_COMM_WORLD) {
  const auto shell = [=](int around, const std::vector<double>& heights, dealii::Triangulation<3>& mesh) {
    std::vector<dealii::Point<3>> x;
    std::vector<dealii::CellData<3>> cells;
    for (const double z : heights)
      for (int i = 0; i < around; ++i)
        for (int k = 0; k <= across; ++k) {
          const double r = a + (b - a) * k / across, t = 2 * dealii::numbers::PI * i / around;
          x.emplace_back(r * std::cos(t), r * std::sin(t), z);
        }
    for (int j = 0; j + 1 < int(heights.size()); ++j)
      for (int i = 0; i < around; ++i)
        for (int k = 0; k < across; ++k) {
          dealii::CellData<3> c;
          for (int v = 0; v < 8; ++v)
            c.vertices[v] =
                ((j + (v >> 2)) * around + (i + (v >> 1 & 1)) % around) * (across + 1) + k + (v & 1);
          cells.push_back(c);
        }
    mesh.create_triangulation(x, cells, dealii::SubCellData());
  };
  dealii::Triangulation<3> rotor_mesh, stator_mesh, both;
  shell(n_below, below, rotor_mesh);
  shell(n_above, above, stator_mesh);
  const double middle = below.back(), top = above.back();
  join<3>(
      rotor_mesh, stator_mesh,
      [=](const dealii::Point<3>& x, bool turns) {
        if (x[2] < 1e-9) return 0;
        if (x[2] > top - 1e-9) return 3;
        if (std::abs(x[2] - middle) < 1e-9) return turns ? 4 : 5;
        return turns ? 1 : 2;
      },
      both);
  auto domain = std::make_unique<Domain<3>>(
      both,
      std::map<dealii::types::boundary_id, std::string>{
          {0, "disc"}, {1, "below"}, {2, "above"}, {3, "lid"}, {4, "rotor top"}, {5, "stator bottom"}},
      std::vector<std::string>(), comm);
  Rotor<3> rotor;
  rotor.pairs = {{"rotor top", "stator bottom"}};
  domain->set_rotor(rotor);
  return domain;
}

/// Refines some cells at the interface of either side: hanging nodes there.
template <int dim>
void refine_some(Domain<dim>& domain) {
  for (const auto& cell : domain.triangulation().active_cell_iterators())
    if (cell->is_locally_owned() && cell->center()[0] + 0.3 * cell->center()[1] > 0.2)
      cell->set_refine_flag();
  domain.triangulation().execute_coarsening_and_refinement();
}

}  // namespace seedflow
