#pragma once

#include <iosfwd>
#include <vector>

#include "seedflow/coupling/bodies.h"
#include "seedflow/coupling/body_loads.h"
#include "seedflow/coupling/momentum_ledger.h"
#include "seedflow/coupling/solid_seeds.h"
#include "seedflow/coupling/void_fraction.h"
#include "seedflow/fluid/fluid.h"

namespace seedflow {

/// One step of air and seeds together. Has a Fluid and a Dem; neither knows the other.
///
///   weights at the bodies' places -> void fraction and its rate (Eq. 5) -> average the air at the bodies ->
///   effects (Eqs. 6-7) -> deposit drag and forces with the same weights (Eq. 8) -> air step, drag implicit
///   -> average again -> DEM substeps -> what seeds received and the air did not yet, is handed to the next
///   step
///
/// Bodies outside the mesh (Coupling/Outside the mesh) see air at rest, and nothing of them reaches the air.
///
/// The drag coefficient that the air sees is k M / (M + K dt) (M mass and K summed drag of the seed): the
/// seed's own answer within the step, so that any drag strength is stable.
class CoupledStep {
 public:
  /// The objects must outlive this one. `kernel_width` is the Gaussian's standard deviation [m].
  CoupledStep(const CouplingParameters& parameters, double kernel_width, Fluid<3>& fluid,
              const PointLocation<3>& location, Dem& dem, EffectSet& effects, const AirProperties& air,
              const Vec3& gravity, MPI_Comm comm);

  /// Seeds are solid near the places of `seeds`, which must outlive this object: bodies there have no force
  /// by effects but their hydrostatic buoyancy; what the air does to the seed is that of SolidSeeds.
  void use(SolidSeeds& seeds) { solid_seeds = &seeds; }

  /// The void fraction that the air holds at present, on the mesh as it is now: of the seeds' places at the
  /// start of the last step (before the first one, their places now). For the air's initial state and after a
  /// change of the mesh.
  std::vector<double> void_fraction();

  void advance(double dt);

  const Bodies& bodies() const { return all_bodies; }
  BodyLoads& loads() { return body_loads; }
  /// What the bodies saw of the air after the last step.
  const AirAtBodies& air_at_bodies() const { return seen; }
  /// Force of the air on each body over the last step, buoyancy included [N].
  const std::vector<Vec3>& force_on_bodies() const { return body_force; }
  const MomentumLedger& momentum() const { return ledger; }
  /// Number of bodies outside the mesh at the last step.
  std::size_t n_outside() const { return outside.size(); }
  /// CPU seconds on this rank in air and seeds; the rest of advance() is coupling.
  double air_seconds() const { return in_air; }
  double seed_seconds() const { return in_seeds; }
  double largest_volume_error() const { return volume_error; }
  void save(std::ostream& out) const;
  void load(std::istream& in);

 private:
  void place(double dt);
  void look();
  void deposit(double dt);
  void push_seeds(double dt);
  void book(double dt);

  CouplingParameters parameters;
  double sigma;
  Fluid<3>& fluid;
  const PointLocation<3>& location;
  Dem& dem;
  AirProperties air;
  Vec3 gravity;
  MPI_Comm comm;

  Bodies all_bodies;
  VoidFraction solid;
  PointExchange weights;  ///< rows: bodies
  BodyLoads body_loads;
  SolidSeeds* solid_seeds = nullptr;
  Exchange<3> exchange;
  AirAtBodies seen;
  MomentumLedger ledger;

  // One entry per body.
  std::vector<double> air_drag;       ///< drag coefficient the air sees [kg/s]
  std::vector<Vec3> explicit_on_air;  ///< [N]
  std::vector<Vec3> pressure_share;   ///< integral of (1 - eps) grad p over the body's volume, model A [N]
  std::vector<Vec3> remainder;        ///< received by the body and not yet by the air, on the air [N s]
  std::vector<Vec3> body_force;       ///< [N]
  std::vector<long> outside;          ///< bodies outside the mesh, ascending
  double in_air = 0, in_seeds = 0;
  Vec3 wall_impulse, seeds_momentum;  ///< before the step
  double volume_error = 0;
};

}  // namespace seedflow
