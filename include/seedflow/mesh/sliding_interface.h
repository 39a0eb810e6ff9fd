#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "seedflow/mesh/domain.h"

namespace seedflow {

/// Where rotor and stator of a domain touch at a given angle: the faces of both sides, and the pieces into
/// which each cuts the other. Known to all ranks alike, so nothing is searched or sent when the rotor turns.
///
/// A face is a quadrilateral in the parameters of its surface: in a plane across the axis two lengths; on the
/// cylinder the arc R theta and the length along the axis (in 2D R theta alone), where the faces must be
/// rectangles. Two faces share the convex polygon in which they overlap, so the pieces and the uncovered
/// rest of a face sum to its area exactly. On the cylinder the cells end at chords; the two sides' chords do
/// not coincide. A parameter then belongs to one point on either chord, and `gap` is what lies between.
///
/// Errors: InputError if the boundaries do not lie on one plane or cylinder (with both positions or radii),
/// a face on the cylinder is no rectangle, or a named boundary has no faces.
template <int dim>
class SlidingInterface {
 public:
  enum Side { rotor = 0, stator = 1 };
  static constexpr int n_vertices = 1 << dim, n_corners = 1 << (dim - 1);

  struct Face {
    Side side;
    int pair;             ///< index into Rotor::pairs
    unsigned int number;  ///< of the face in its cell
    unsigned int owner;   ///< rank that owns the cell
    std::uint32_t cell;   ///< among the locally owned active cells of that rank, in traversal order
    std::array<dealii::Point<dim>, n_vertices> vertex;  ///< of the cell, rotor at angle 0 [m]
    double area = 0;                                    ///< in the parameters [m^(dim-1)]
    double covered = 0;  ///< part of `area` with a partner at the present angle

    double uncovered() const { return covered > (1 - 1e-10) * area ? 0 : area - covered; }
  };
  /// A quadrature point of a piece.
  struct Point {
    std::array<dealii::Point<dim - 1>, 2> at;  ///< reference coordinates on the rotor's and stator's face
    double weight;                             ///< parameter area [m^(dim-1)]
  };
  struct Piece {
    std::array<std::uint32_t, 2> face;  ///< of the rotor and of the stator
    std::uint32_t begin, end;           ///< its points
  };
  /// What a face is at a point.
  struct FacePoint {
    dealii::Point<dim> position;     ///< at the present angle [m]
    dealii::Tensor<1, dim> normal;   ///< outward, times face area per parameter area
    dealii::Tensor<1, dim - 1> arc;  ///< d(reference coordinates)/d(R theta); zero in a plane [1/m]
  };

  /// `degree` of the shape functions, for the quadrature on the pieces.
  SlidingInterface(const Domain<dim>& domain, int degree);

  /// Cuts the faces at this angle [rad]. Local to each rank.
  void turn_to(double angle);
  double angle() const { return present; }
  const Rotor<dim>& rotor_description() const { return description; }

  const std::vector<Face>& faces() const { return all; }
  const std::vector<Piece>& pieces() const { return cut; }
  const std::vector<Point>& points() const { return point; }
  bool on_cylinder(const Face& face) const { return surfaces[face.pair].radius > 0; }

  FacePoint at(const Face& face, const dealii::Point<dim - 1>& reference) const;
  /// Gauss points of a whole face, exact for products of three shape functions.
  const std::vector<dealii::Point<dim - 1>>& gauss_points() const { return gauss; }
  /// Their parameter areas on this face.
  void gauss_weights(const Face& face, std::vector<double>& weight) const;

  /// The reference coordinates of the cell of a point of its face.
  static dealii::Point<dim> in_cell(unsigned int face_number, const dealii::Point<dim - 1>& reference);
  /// The directions of the face's reference coordinates in the cell.
  static std::array<int, 2> directions(unsigned int face_number);
  /// The vertex of the cell at a corner of a face, corners numbered lexicographically in directions().
  static int vertex_at(unsigned int face_number, int corner);

 private:
  struct Surface {
    double radius = 0;    ///< of the cylinder [m]; 0: a plane
    double position = 0;  ///< of the plane along the axis [m]
    double cell = 1;      ///< of the lookup table [m]
    std::array<double, 2> low{}, high{};
    std::array<int, 2> n{1, 1};
    std::vector<std::uint32_t> start, entry;  ///< faces of the stator in each cell of the table
  };
  using Corner = std::array<double, 2>;

  void gather(const Domain<dim>& domain);
  void classify();
  void build_table(int pair);
  Corner parameter(const Surface& surface, const dealii::Point<dim>& x) const;
  void cut_pair(int pair);
  void add_piece(std::uint32_t a, std::uint32_t b, const std::vector<Corner>& polygon, double shift);
  dealii::Point<dim - 1> reference_of(std::uint32_t face, const Corner& x) const;

  Rotor<dim> description;
  std::array<dealii::Tensor<1, 3>, 2> basis;  ///< across the axis
  double present = 0;
  dealii::Tensor<2, dim> turn_matrix;
  std::vector<Face> all;
  std::vector<std::array<Corner, n_corners>> corner;  ///< in the parameters, at the present angle
  std::vector<std::array<Corner, n_corners>> corner_at_rest;
  std::vector<Surface> surfaces;
  std::vector<Piece> cut;
  std::vector<Point> point;
  std::vector<dealii::Point<dim - 1>> gauss;
  std::vector<double> gauss_weight;
  std::vector<dealii::Point<2>> triangle_point;
  std::vector<double> triangle_weight;
};

}  // namespace seedflow
