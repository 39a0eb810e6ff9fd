#pragma once

#include <cstdint>
#include <vector>

#include "seedflow/fluid/exchange.h"
#include "seedflow/mesh/point_location.h"
#include "seedflow/mesh/quadrature_layout.h"
#include "seedflow/seeds/dem.h"

namespace seedflow {

/// Seeds as solid bodies in the air near given places (holes that suck), where the mesh resolves them.
///
/// Every point of the air that is inside a seed and nearer than `reach` to one of the places is bound to the
/// seed's motion v + omega x r by a resistance beta (volume penalisation: Angot, Bruneau & Fabrie 1999,
/// doi:10.1007/s002110050401):
///     f = beta (v + omega x r - u)  on the air [N/m3],    F = int beta (u - v - omega x r) dV  on the seed.
/// Inside the seed the air's momentum equation is beta (u - v) = -grad p but for the inertia of the little
/// air there, so F = -oint p n dA: the pressure on the seed's surface, or on the part of it within reach.
/// This is all the force a seed has from the air within reach. It is taken from the air at the same points in
/// the same step, so nothing is booked twice and nothing waits for the next step; no drag law and no
/// pressure-gradient force must be added for what is within reach (CoupledStep leaves them out).
///
/// A seed is the ball of its volume; its torque by the air is left out (pressure has none on a ball). A gap
/// narrower than the mesh is closed: the ball counts as larger by `margin` times the local cell size, at most
/// by a quarter of its radius. What still flows through a seed is of the order dp/(beta R), 0.2 m/s at 3 kPa.
///
/// All ranks know all seeds; each knows its own points.
class SolidSeeds {
 public:
  /// \param resistance beta [kg/(m3 s)] \param margin [1] \param reach [m]
  SolidSeeds(double resistance, double margin, double reach, const PointLocation<3>& location,
             const QuadratureLayout<3>& layout, MPI_Comm comm)
      : beta(resistance), margin(margin), reach(reach), location(location), layout(layout), comm(comm) {}

  /// From the next step on [m].
  void set_places(const std::vector<Vec3>& centres) { places = centres; }
  /// The air's points have still to be turned by this angle about the z axis to stand relative to the seeds
  /// as they should (a frozen rotor's mesh lags behind its disc), [rad].
  void set_lag(double angle) { lag = angle; }
  /// Whether a point is within reach of a place.
  bool covers(const Vec3& x) const;

  /// Finds the points inside the seeds, at the seeds' places `ahead` [s] from now by their present motion.
  void mark(const Dem& dem, double ahead);
  void deposit(Exchange<3>& exchange) const;
  /// After the air's step, with its new velocity. Collective.
  void collect(const std::vector<dealii::Tensor<1, 3>>& velocity);

  /// Force on every seed during the last step [N], the same on all ranks.
  const std::vector<Vec3>& force() const { return forces; }
  /// Number of the marked points of this rank.
  std::size_t n_points() const { return points.size(); }

 private:
  struct Marked {
    std::uint32_t q;
    int seed;
    double square;  ///< of the distance to the seed's centre [m2]
    Vec3 velocity;  ///< of the seed there [m/s]
  };
  double beta, margin, reach;
  const PointLocation<3>& location;
  const QuadratureLayout<3>& layout;
  MPI_Comm comm;
  std::vector<Vec3> places;
  double lag = 0;
  std::vector<Marked> points;  ///< ascending q, each once
  std::vector<Vec3> forces;
};

}  // namespace seedflow
