#pragma once

#include "seedflow/coupling/point_exchange.h"
#include "seedflow/mesh/point_location.h"

namespace seedflow {

/// How a point spreads over the air. Each function fills one row of a PointExchange (the caller ends it with
/// next() and normalizes at the end). All are exact in what they conserve, because the rows are normalized on
/// the very quadrature points that the air integrates with.

/// The cell that contains the point, uniformly (the paper's Eq. 8: sum of F / V_cell).
void add_cell_kernel(PointExchange& row, const PointLocation<3>& location, const QuadratureLayout<3>& layout,
                     const Vec3& point);

/// Eq. 5: a regular lattice of sample points over the bounding box of a sphere, `samples` along the diameter;
/// those inside the sphere count, each for an equal share, uniformly in the cell that contains it. Eq. 5 as
/// printed lacks the division by the cell's volume, which is included. Samples outside the mesh (a sphere
/// that overlaps a wall) leave their share to the others.
void add_sampled_kernel(PointExchange& row, const PointLocation<3>& location,
                        const QuadratureLayout<3>& layout, const Vec3& centre, double radius, int samples);

/// A Gaussian of standard deviation sigma [m], cut off at 4.5 sigma (where it is 4e-5 of its peak). Its width
/// belongs to the seed and not to the cell, so results converge under refinement; smooth in space and time,
/// so that the time derivative of the void fraction is smooth too. Needs sigma of about a cell size; see
/// kernel_width().
void add_gaussian_kernel(PointExchange& row, const PointLocation<3>& location,
                         const QuadratureLayout<3>& layout, const Vec3& centre, double sigma);

inline constexpr double gaussian_cut_off = 4.5;  ///< in units of sigma

}  // namespace seedflow
