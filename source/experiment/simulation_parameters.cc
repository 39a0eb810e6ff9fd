#include "seedflow/experiment/simulation_parameters.h"

#include <algorithm>
#include <cmath>

namespace seedflow {

void SeedsParameters::declare(Parameters& p) {
  const auto section = p.section("Seeds", "The seeds and where they start.");
  model.declare(p);
  p.flag("Rigid", rigid, "true: the sub-spheres of a seed move as one rigid body; false: they are bonded.");
  p.vector("Position", position, "m", Range::any(), "Start of the seed's centre.");
  p.vector("Velocity", velocity, "m/s", Range::any(), "Start velocity of the seed.");
  p.vector("Orientation", orientation, "rad", Range::any(),
           "Start orientation: the rotation vector (axis times angle) of the template.");
  {
    const auto inner = p.section("Material", "Of the seeds (the source paper's Table 3).");
    p.number("Poisson ratio", material.poisson_ratio, "1", Range::between(0, 0.5), "Poisson's ratio.");
    p.number("Shear modulus", material.shear_modulus, "Pa", Range::positive(), "Shear modulus G.");
  }
  const auto inner =
      p.section("Wall material", "Of the walls and of the contact between seed and wall (Table 3).");
  p.number("Poisson ratio", wall_material.poisson_ratio, "1", Range::between(0, 0.5), "Poisson's ratio.");
  p.number("Shear modulus", wall_material.shear_modulus, "Pa", Range::positive(), "Shear modulus G.");
  p.number("Restitution", wall_contact.restitution, "1", {0.0, 1.0, true}, "Coefficient of restitution.");
  p.number("Static friction", wall_contact.static_friction, "1", Range::non_negative(),
           "Coulomb coefficient.");
  p.number("Rolling friction", wall_contact.rolling_friction, "1", Range::non_negative(),
           "Coefficient of rolling friction.");
}

void RunParameters::declare(Parameters& p) {
  const auto section = p.section("Run", "Times and output.");
  p.number("End time", end_time, "s", Range::positive(), "Simulated time.");
  p.number("Air step", air_step, "s", Range::positive(),
           "Step of the air and of the coupling; the seeds take many smaller steps in it (Seeds motion/Time "
           "step).");
  p.number("Series interval", series_interval, "s", Range::positive(), "Between rows of seeds.csv.");
  p.number("Field interval", field_interval, "s", Range::non_negative(),
           "Between ParaView files; 0 writes none.");
  p.number("Checkpoint interval", checkpoint_interval, "s", Range::positive(),
           "Wall time between checkpoints; one is also written when the run is interrupted.");
}

void SimulationParameters::declare(Parameters& p) {
  run.declare(p);
  domain.declare(p);
  {
    const auto section = p.section("Air domain", "");
    refinement.declare(p);
  }
  air.declare(p);
  {
    const auto section = p.section("Air", "");
    p.choice("Model", air_model, {"navier-stokes", "prescribed"},
             "Whether the air is computed, or given by expressions (one-way, cheap).");
    prescribed.declare(p);
  }
  seeds.declare(p);
  dem.declare(p);
  coupling.declare(p);
  effects.declare(p);
}

void SimulationParameters::check(const Parameters& p) {
  effects.prepare();
  seeds.model.check(p, "Seeds", SeedTemplateParameters());
  if (seeds.model.shape == "csv") {  // the template states what is entered otherwise
    const SeedTemplate model = make_seed_template(seeds.model);
    seeds.model.diameter = std::cbrt(6 / M_PI * model.seed_volume);
    seeds.model.density = model.seed_density;
    seeds.model.n_spheres = model.n_spheres();
  }
  seeds.material.density = seeds.model.density;
  if (air_model == "navier-stokes") coupling.check(p);
  if (run.air_step > run.end_time) p.reject("Run/Air step", "it is longer than the run", "use a smaller one");
  for (int d = 0; d < 3; ++d)
    if (!(domain.lower[d] < domain.upper[d]))
      p.reject("Air domain/Upper corner", "it must lie above Lower corner in every direction",
               "give the box a volume");
  if (domain.cells.size() != 3 ||
      std::any_of(domain.cells.begin(), domain.cells.end(), [](double n) { return n != std::floor(n); }))
    p.reject("Air domain/Cells", "three whole numbers are needed, one per direction",
             "write them like 10, 10, 40");
  for (int d = 0; d < 3; ++d)
    if (!(domain.lower[d] < seeds.position[d] && seeds.position[d] < domain.upper[d]))
      p.reject("Seeds/Position", "the seed starts outside the air domain",
               "choose a place between Air domain/Lower corner and Upper corner");
  if (air_model == "navier-stokes" && coupling.exchange_kernel == "gaussian") {
    double coarsest = 0;
    for (int d = 0; d < 3; ++d)
      coarsest = std::max(coarsest, (domain.upper[d] - domain.lower[d]) / domain.cells[d]);
    // Cells around a seed have the highest level if the mesh follows the seeds.
    const bool follows = refinement.interval > 0 && refinement.seed_distance > 0;
    coarsest /= std::pow(2.0, follows ? refinement.max_level : domain.refinements);
    if (kernel_width() < 0.5 * coarsest)
      p.reject("Coupling/Kernel width",
               "the Gaussian's standard deviation is smaller than half a cell, so the mesh "
               "cannot carry it",
               "use at least " + std::to_string(0.5 * coarsest) + " m, or smaller cells");
  }
}

}  // namespace seedflow
