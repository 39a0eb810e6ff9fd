#pragma once

#include <string>
#include <vector>

#include "seedflow/base/parameters.h"
#include "seedflow/effects/model_effects.h"
#include "seedflow/seeds/dem.h"
#include "seedflow/seeds/material_table.h"
#include "seedflow/seeds/template_parameters.h"

namespace seedflow {

/// What the experiments with many seeds and no air have in common. Defaults: the paper's seed and Table 3.
struct GranularParameters {
  // Section "Run".
  double end_time = 2;                ///< simulated time after the start of the experiment [s]
  double series_interval = 5e-3;      ///< between rows of series.csv [s]
  double field_interval = 0.1;        ///< between ParaView files, 0: none [s]
  bool sub_spheres_in_files = false;  ///< ParaView files hold sub-spheres instead of whole seeds
  double checkpoint_interval = 300;   ///< [s], wall time

  // Section "Seeds".
  SeedTemplateParameters model;
  bool rigid = true;

  std::string seed_material = "seed";

  // Sections "Materials" and "Contact pairs".
  MaterialTable materials;

  // Section "Filling".
  double mass = 0.1;              ///< of all seeds together [kg]
  double diameter_deviation = 0;  ///< [m]
  int random_number = 1;          ///< places and orientations of the filling
  double rest_energy = 1e-9;      ///< kinetic energy per seed below which the seeds are at rest [J]
  double longest_filling = 2;     ///< [s]
  std::string cache;              ///< folder with the state of a settled filling, or ""

  DemParameters dem;

  /// Effect "Air drag" of the experiments that compute no air; these declare it (declare_air_drag), others
  /// leave it off.
  Effect air_drag{seedflow::air_drag()};

  GranularParameters() = default;
  /// With the materials that the file or the overrides name.
  GranularParameters(const std::string& file, const std::vector<std::string>& overrides)
      : materials(MaterialTable::named_in(file, overrides)) {}
  void declare(Parameters& parameters);
  void declare_air_drag(Parameters& parameters);
  /// After reading: cross-checks. `wall_materials`: entries that name a material. Throws InputError.
  void check(const Parameters& parameters, const std::vector<std::string>& wall_materials);

  /// The models of seeds, one per size class; their mean mass is the mass of the middle one to second order.
  std::vector<SeedTemplate> templates() const;
  static constexpr int n_size_classes = 5;
};

}  // namespace seedflow
