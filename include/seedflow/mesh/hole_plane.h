#pragma once

#include <deal.II/base/point.h>
#include <deal.II/grid/tria.h>

#include <array>
#include <vector>

namespace seedflow {

/// Layers that fill `length`, the first about `first` wide, each about `growth` times the one before, none
/// much wider than `largest` [m]. Returns the distances of their ends from the start; the last is `length`.
std::vector<double> graded_layers(double length, double first, double growth, double largest);

/// A plate with round holes seen along their axes: quadrilaterals, some of them inside a hole, whose nodes
/// move with the hole's radius, so that copies of the plane at other heights can be wider (chamfer). Copies
/// are joined to layers of hexahedra.
///
/// A hole is a polygon of 4 m sides with the area of the circle: refining its straight sides changes neither
/// the shape nor the area, and hanging nodes lie on the coarse edges. A square core of m x m cells is joined
/// to it by rings, and rings join it to a loop of 4 m nodes around it.
class HolePlane {
 public:
  struct Node {
    dealii::Point<2> fixed;          ///< position = fixed + R by_radius [m]
    dealii::Tensor<1, 2> by_radius;  ///< R: radius of the circle [m]
  };
  struct Quad {
    std::array<unsigned int, 4> node;  ///< lexicographic, counter-clockwise seen from +z
    bool in_hole;
  };
  std::vector<Node> nodes;
  std::vector<Quad> quads;

  unsigned int add_node(const dealii::Point<2>& position);
  void add_quad(unsigned int a, unsigned int b, unsigned int c, unsigned int d, bool in_hole = false) {
    quads.push_back({{a, b, c, d}, in_hole});
  }

  /// \param along  direction of the loop's first side, from its first node; the first corner lies at -135
  ///               degrees from it
  /// \param core_rings   rings between core and polygon
  /// \param outside      where rings outside end, from 0 (polygon) to 1 (loop), both left out
  /// \param loop         4 m nodes, counter-clockwise from the first corner
  void add_hole(const dealii::Point<2>& centre, const dealii::Tensor<1, 2>& along, int core_rings,
                const std::vector<double>& outside, const std::vector<unsigned int>& loop);

  /// At which angles, as seen from the centre, the nodes of one side of the loop should lie: tan of the angle
  /// from the side's middle, -1 to 1, m + 1 values.
  static std::vector<double> side_positions(int m);

  /// A copy of the plane at height z with the holes' radius there.
  struct Level {
    double z, radius;  ///< [m]
    bool only_holes;   ///< the layer that begins here consists of the holes alone
  };
  /// Appends the hexahedra between successive levels (the last one's only_holes is not used), those with
  /// `keep` of their plane centre.
  template <typename Keep>
  void extrude(const std::vector<Level>& levels, dealii::types::material_id material, const Keep& keep,
               std::vector<dealii::Point<3>>& vertices, std::vector<dealii::CellData<3>>& cells) const;
};

template <typename Keep>
void HolePlane::extrude(const std::vector<Level>& levels, dealii::types::material_id material,
                        const Keep& keep, std::vector<dealii::Point<3>>& vertices,
                        std::vector<dealii::CellData<3>>& cells) const {
  const std::size_t first = vertices.size();
  for (const Level& level : levels)
    for (const Node& n : nodes) {
      const dealii::Point<2> x = n.fixed + level.radius * n.by_radius;
      vertices.emplace_back(x[0], x[1], level.z);
    }
  for (std::size_t l = 0; l + 1 < levels.size(); ++l)
    for (const Quad& q : quads) {
      if (levels[l].only_holes && !q.in_hole) continue;
      dealii::Point<2> centre;
      for (const unsigned int n : q.node)
        centre += 0.25 * (nodes[n].fixed + levels[l].radius * nodes[n].by_radius);
      if (!keep(centre)) continue;
      dealii::CellData<3> cell;
      for (int v = 0; v < 4; ++v) {
        cell.vertices[v] = first + l * nodes.size() + q.node[v];
        cell.vertices[4 + v] = cell.vertices[v] + nodes.size();
      }
      cell.material_id = material;
      cells.push_back(cell);
    }
}

}  // namespace seedflow
