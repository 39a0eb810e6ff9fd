#pragma once

#include "seedflow/coupling/coupling_parameters.h"
#include "seedflow/effects/catalogue.h"
#include "seedflow/fluid/parameters.h"
#include "seedflow/fluid/prescribed_air.h"
#include "seedflow/mesh/domain.h"
#include "seedflow/mesh/refinement.h"
#include "seedflow/seeds/dem.h"
#include "seedflow/seeds/template_parameters.h"

namespace seedflow {

/// Section "Seeds": which seeds there are and where they start.
struct SeedsParameters {
  SeedTemplateParameters model;
  bool rigid = false;
  Vec3 position;     ///< of the centre [m]
  Vec3 velocity;     ///< [m/s]
  Vec3 orientation;  ///< rotation vector [rad]
  Material material;
  Material wall_material{"wall", 1800, 0.35, 1.3e9};
  ContactProperties wall_contact{0.627, 0.41, 0.026};

  void declare(Parameters& parameters);
};

/// Section "Run": times and output.
struct RunParameters {
  double end_time = 0.2;             ///< [s]
  double air_step = 1e-3;            ///< [s]
  double series_interval = 1e-3;     ///< [s]
  double field_interval = 0.02;      ///< of ParaView files; 0: none [s]
  double checkpoint_interval = 600;  ///< of wall time [s]

  void declare(Parameters& parameters);
};

/// Everything a coupled run of air and seeds is made of. Bound to a Parameters object by declare(), so it
/// must not move between declare() and Parameters::read().
struct SimulationParameters {
  RunParameters run;
  std::string air_model = "navier-stokes";  ///< navier-stokes | prescribed
  DomainParameters domain;
  RefinementParameters refinement;
  FluidParameters air;
  PrescribedAirParameters prescribed;
  SeedsParameters seeds;
  DemParameters dem;
  CouplingParameters coupling;
  EffectSet effects;

  void declare(Parameters& parameters);
  /// Cross-checks, after Parameters::read(). Throws InputError.
  void check(const Parameters& parameters);

  /// Standard deviation of the Gaussian kernel [m].
  double kernel_width() const {
    return coupling.kernel_width > 0 ? coupling.kernel_width : seeds.model.diameter;
  }
};

}  // namespace seedflow
