// Setting up a Dem: what it is made of, and the checks before it runs.

#include <cmath>
#include <sstream>

#include "seedflow/base/parameters.h"
#include "seedflow/seeds/dem.h"

namespace seedflow {

void DemParameters::declare(Parameters& p) {
  const auto section = p.section("Seeds motion", "Discrete element method of the seeds.");
  p.number("Time step", time_step, "s", Range::positive(),
           "Largest substep; checked against its limits before the run.");
  p.vector("Gravity", gravity, "m/s2", Range::any(), "Acceleration of gravity.");
  bonds.declare(p);
}

int Dem::add_material(const Material& m) {
  material.push_back(m);
  return static_cast<int>(material.size()) - 1;
}

int Dem::add_template(const SeedTemplate& model, int material_index, bool rigid) {
  if (material_index < 0 || material_index >= static_cast<int>(material.size()))
    throw InputError("Template '" + model.name + "': there is no material number " +
                     std::to_string(material_index) + ".");
  if (model.n_spheres() == 0 || !(model.mass > 0))
    throw InputError("Template '" + model.name +
                     "' has no sub-spheres or no mass. Call finish() on it first.");
  SeedStore s;
  s.model = model;
  s.material = material_index;
  s.rigid = rigid || model.n_spheres() == 1;
  store.push_back(s);
  bonds.emplace_back(model, parameters.bonds);
  return static_cast<int>(store.size()) - 1;
}

void Dem::set_domain(const Vec3& a, const Vec3& b) {
  low = a, high = b;
  bounded = true;
}

int Dem::add_seed(int seed_template, const Vec3& centre, const Quaternion& orientation, const Vec3& velocity,
                  const Vec3& spin) {
  if (seed_template < 0 || seed_template >= static_cast<int>(store.size()))
    throw InputError("There is no seed template number " + std::to_string(seed_template) + ".");
  const int number = n_seeds();
  SeedStore& s = store[seed_template];
  const int slot = s.add(number, centre, normalized(orientation), velocity, spin);
  if (slot % lane_width == 0) bonds[seed_template].add_block();
  slots.push_back({seed_template, slot});
  first.push_back(n_spheres() + s.n_spheres());
  sphere_radius.insert(sphere_radius.end(), s.model.radius.begin(), s.model.radius.end());
  sphere_mass.insert(sphere_mass.end(), s.model.sphere_mass.begin(), s.model.sphere_mass.end());
  forces_known = false;
  load_step = 0;
  return number;
}

void Dem::check() const {
  for (int seed = 0; seed < n_seeds(); ++seed) {
    const Vec3 x = seed_state(seed).centre;
    if (bounded &&
        (x.x < low.x || x.y < low.y || x.z < low.z || x.x > high.x || x.y > high.y || x.z > high.z)) {
      std::ostringstream text;
      text << "Seed " << seed << " starts at (" << x.x << ", " << x.y << ", " << x.z
           << ") m, outside the domain from (" << low.x << ", " << low.y << ", " << low.z << ") to ("
           << high.x << ", " << high.y << ", " << high.z << ") m. Move the seed or enlarge the domain.";
      throw InputError(text.str());
    }
  }
}

}  // namespace seedflow
