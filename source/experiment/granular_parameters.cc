#include "seedflow/experiment/granular_parameters.h"

#include <cmath>

#include "seedflow/base/error.h"

namespace seedflow {

void GranularParameters::declare(Parameters& p) {
  {
    const auto section = p.section("Run", "Times and output.");
    p.number(
        "End time", end_time, "s", Range::positive(),
        "Simulated time after the start of the experiment (gate opened, drum turning); the filling comes "
        "before it and is not counted.");
    p.number("Series interval", series_interval, "s", Range::positive(), "Between rows of series.csv.");
    p.number("Field interval", field_interval, "s", Range::non_negative(),
             "Between ParaView files; 0 writes none.");
    p.flag("Sub-spheres in files", sub_spheres_in_files,
           "ParaView files hold all sub-spheres instead of one ball per seed.");
    p.number("Checkpoint interval", checkpoint_interval, "s", Range::positive(),
             "Wall time between checkpoints; one is also written when the run is interrupted.");
  }
  {
    const auto section = p.section("Seeds", "The model of a seed.");
    model.declare(p);
    p.flag("Rigid", rigid, "true: the sub-spheres of a seed move as one rigid body; false: they are bonded.");
    p.text("Material", seed_material, "Of the seeds, one of Materials/Names.");
  }
  materials.declare(p);
  {
    const auto section = p.section("Filling", "How the seeds get where the experiment begins.");
    p.number("Mass", mass, "kg", Range::positive(), "Of all seeds together; their number follows.");
    p.number(
        "Diameter deviation", diameter_deviation, "m", Range::non_negative(),
        "Standard deviation of the seeds' diameters, normally distributed in five classes of equal number. "
        "The paper's seeds: 0.1 mm; 0 makes all alike.");
    p.integer("Random number", random_number, Range::between(0, 1e9),
              "Another one gives another repetition of the experiment.");
    p.number("Rest energy", rest_energy, "J", Range::positive(),
             "The filling is at rest when its kinetic energy per seed is below this.");
    p.number("Longest time", longest_filling, "s", Range::positive(),
             "A filling that is not at rest by then is an error.");
    p.text("Cache", cache,
           "Folder with the state of a settled filling: used if it is there, else made. Empty: none.");
  }
  dem.declare(p);
}

void GranularParameters::declare_air_drag(Parameters& p) {
  const auto section = p.section("Effects", "");
  air_drag.declare(p);
}

void GranularParameters::check(const Parameters& p, const std::vector<std::string>& wall_materials) {
  model.check(p, "Seeds", SeedTemplateParameters());
  materials.check(p, {seed_material});
  const auto require_material = [&](const std::string& entry, const std::string& name) {
    try {
      materials.number(name);
    } catch (const InputError& error) {
      p.reject(entry, error.what(), "name one of Materials/Names");
    }
  };
  require_material("Seeds/Material", seed_material);
  for (const std::string& entry : wall_materials) require_material(entry, p.value(entry));
  if (mass < M_PI / 12 * model.density * std::pow(model.diameter, 3))
    p.reject("Filling/Mass", "it is less than half the mass of one seed", "use a larger mass");
  if (diameter_deviation > 0.2 * model.diameter)
    p.reject("Filling/Diameter deviation", "it is more than a fifth of the diameter",
             "use a smaller one, or 0 for seeds that are all alike");
  if (series_interval > end_time)
    p.reject("Run/Series interval", "it is longer than the run", "use a shorter one");
}

std::vector<SeedTemplate> GranularParameters::templates() const {
  if (diameter_deviation == 0) return {make_seed_template(model)};
  // Means of a standard normal variable over its five quintiles.
  const double quintiles[n_size_classes] = {-1.3998, -0.5319, 0, 0.5319, 1.3998};
  std::vector<SeedTemplate> all;
  for (const double q : quintiles) {
    SeedTemplateParameters one = model;
    one.diameter += q * diameter_deviation;
    one.sphere_radius *= one.diameter / model.diameter;
    all.push_back(make_seed_template(one));
  }
  return all;
}

}  // namespace seedflow
