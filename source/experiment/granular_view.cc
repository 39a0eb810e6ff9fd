#include "seedflow/experiment/granular_view.h"

namespace seedflow {

std::vector<Disc> seeds_from(const View& view, const Dem& dem) {
  std::vector<Vec3> centres;
  std::vector<double> radii;
  for (int s = 0; s < dem.n_seeds(); ++s) {
    centres.push_back(dem.seed_state(s).centre);
    radii.push_back(0.5 * dem.seed_template(s).equivalent_diameter);
  }
  return seen_from(view, centres, radii);
}

std::vector<Disc> spheres_from(const View& view, const Dem& dem) {
  std::vector<Vec3> centres;
  dem.positions(centres);
  return seen_from(view, centres, dem.radii());
}

std::vector<int> groups_of(const Dem& dem) {
  std::vector<int> groups;
  for (int s = 0; s < dem.n_seeds(); ++s) groups.push_back(dem.seed_group(s));
  return groups;
}

double kinetic_energy_per_seed(const Dem& dem) {
  return dem.n_seeds() > 0 ? dem.energies().kinetic / dem.n_seeds() : 0;
}

}  // namespace seedflow
