#include "seedflow/base/parameters.h"
#include "seedflow/experiment/experiment.h"
#include "seedflow/experiment/metering.h"
#include "seedflow/experiment/oblique_impact.h"
#include "seedflow/experiment/orifice.h"
#include "seedflow/experiment/repose_angle.h"
#include "seedflow/experiment/rotating_drum.h"
#include "seedflow/experiment/settling.h"
#include "seedflow/experiment/settling_study.h"
#include "seedflow/experiment/settling_tank.h"
#include "seedflow/experiment/single_seed.h"
#include "seedflow/experiment/slope_screening.h"

namespace seedflow {

std::vector<Experiment> experiment_catalogue() {
  return {
      {"settling", "one bonded seed falls in a fluid", run_settling, describe_settling, settling_observer},
      {"settling study", "five seed models x readings x kinds of drag, beside the paper's Table 5",
       run_settling_study, describe_settling_study},
      {"settling tank", "a sphere in a closed tank, beside measurements", run_settling_tank,
       describe_settling_tank},
      {"oblique impact", "a sphere against a plane at all angles, beside measurements", run_oblique_impact,
       describe_oblique_impact, oblique_impact_observer},
      {"single seed", "one seed in a prescribed flow, in milliseconds", run_single_seed_experiment,
       describe_single_seed, single_seed_observer},
      {"orifice", "air through one hole of a disc, beside a published discharge coefficient",
       run_orifice_experiment, describe_orifice},
      {"repose angle", "seeds fall from a box and form a heap", run_repose_angle, describe_repose_angle,
       repose_angle_observer},
      {"repose angle study", "its angle for the paper's seed models, with repeats", run_repose_angle_study,
       describe_repose_angle},
      {"slope screening", "seeds flow down an inclined plate with holes into five bins", run_slope_screening,
       describe_slope_screening, slope_screening_observer},
      {"slope screening study", "what passes, for the paper's seed models or against the inclination",
       run_slope_screening_study, describe_slope_screening},
      {"rotating drum", "two colours of seeds mix in a turning drum", run_rotating_drum,
       describe_rotating_drum, rotating_drum_observer},
      {"rotating drum study", "mixing index and surface for the paper's seed models and speeds",
       run_rotating_drum_study, describe_rotating_drum},
      {"metering", "an air-suction disc takes seeds from a chamber and lays them", run_metering,
       describe_metering, metering_observer, write_metering_geometry},
      {"metering map", "its seeding quality over vacuum, speed and hole diameter", run_metering_map,
       describe_metering}};
}

void declare_experiment_name(Parameters& parameters, std::string& name) {
  std::vector<std::string> names;
  for (const Experiment& experiment : experiment_catalogue()) names.push_back(experiment.name);
  parameters.choice("Experiment", name, names, "What is run.");
}

}  // namespace seedflow
