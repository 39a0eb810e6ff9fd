// Setting up a Dem: what it is made of, and the checks before it runs.

#include <algorithm>
#include <cmath>
#include <sstream>

#include "seedflow/base/error.h"
#include "seedflow/base/parameters.h"
#include "seedflow/seeds/dem.h"

namespace seedflow {
namespace {

std::string text_of(const Vec3& x) {
  std::ostringstream text;
  text << "(" << x.x << ", " << x.y << ", " << x.z << ") m";
  return text.str();
}

}  // namespace

void DemParameters::declare(Parameters& p) {
  const auto section = p.section("Seeds motion", "Discrete element method of the seeds.");
  p.number("Time step", time_step, "s", Range::positive(),
           "Largest substep; checked against its limits before the run.");
  p.vector("Gravity", gravity, "m/s2", Range::any(), "Acceleration of gravity.");
  bonds.declare(p);
  contacts.declare(p);
  limits.declare(p);
}

int Dem::add_material(const Material& m) {
  material.push_back(m);
  const int number = static_cast<int>(material.size()) - 1;
  for (int other = 0; other <= number; ++other) set_contact(number, other, {});
  return number;
}

void Dem::set_contact(int a, int b, const ContactProperties& properties) {
  if (!(properties.restitution > 0 && properties.restitution <= 1))
    throw InputError("Contact between '" + material[a].name + "' and '" + material[b].name +
                     "': restitution is " + std::to_string(properties.restitution) +
                     ", allowed is above 0 up to 1.");
  contacts.set_law(a, b, ContactLaw(material[a], material[b], properties));
}

int Dem::add_wall(const Wall& w) {
  if (w.material < 0 || w.material >= static_cast<int>(material.size()))
    throw InputError("Wall '" + w.name + "': there is no material number " + std::to_string(w.material) +
                     ".");
  park();
  all_walls.push_back(w);
  all_walls.back().check();
  wall_impulse.emplace_back();
  wall_force.emplace_back();
  return static_cast<int>(all_walls.size()) - 1;
}

void Dem::add_box(const Vec3& a, const Vec3& b, int material_index) {
  const char* const axes = "xyz";
  for (int c = 0; c < 3; ++c) {
    Vec3 normal;
    normal[c] = 1;
    add_wall({std::string(1, axes[c]) + "-", a, normal, {}, material_index});
    add_wall({std::string(1, axes[c]) + "+", b, -normal, {}, material_index});
  }
  set_domain(a, b);
}

Wall& Dem::wall(int w) {
  park();
  return all_walls.at(w);
}

void Dem::set_wall_velocity(int w, const Vec3& velocity) {
  Wall& changed = wall(w);
  const Placement present = placement(changed, now);
  if (norm(present.shift) > 0 || norm(present.turn.v) > 0)
    throw InputError("Wall '" + changed.name +
                     "' has moved already: give it its whole motion before it starts (Wall::motion).");
  changed.motion = WallMotion::constant(velocity);
  changed.motion.displacement.start = now;
  changed.check();
}

void Dem::set_wall_active(int w, bool active) {
  wall(w).active = active;
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

std::vector<TimeStepLimit> Dem::time_step_limits() const {
  std::vector<TimeStepLimit> limits;
  const TimeStepParameters& p = parameters.limits;
  for (std::size_t t = 0; t < store.size(); ++t) {
    const SeedStore& s = store[t];
    if (s.seed.empty()) continue;
    TimeStepLimit rayleigh{"", 1e300, p.rayleigh_fraction, "Rayleigh fraction"};
    TimeStepLimit hertz{"", 1e300, p.hertz_fraction, "Hertz fraction"};
    for (int i = 0; i < s.n_spheres(); ++i) {
      const double r = s.model.radius[i], mass = s.rigid ? s.model.mass : s.model.sphere_mass[i];
      const double density = s.model.sphere_mass[i] / (4.0 / 3 * M_PI * r * r * r);
      std::ostringstream which;
      which << "sub-sphere of radius " << r << " m of template '" << s.model.name << "'";
      const double wave = rayleigh_time(r, density, material[s.material]);
      if (wave < rayleigh.full) rayleigh.full = wave, rayleigh.cause = "Rayleigh wave on a " + which.str();
      for (const SeedStore& other : store) {
        if (other.seed.empty()) continue;
        const double young = contacts.law(s.material, other.material).young;
        for (int j = 0; j < other.n_spheres(); ++j) {
          const double r2 = other.model.radius[j],
                       mass2 = other.rigid ? other.model.mass : other.model.sphere_mass[j];
          const double time =
              hertz_time(r * r2 / (r + r2), mass * mass2 / (mass + mass2), young, p.impact_speed);
          if (time >= hertz.full) continue;
          hertz.full = time;
          hertz.cause = "Hertz contact of a " + which.str() + " with one of '" + other.model.name + "'";
        }
      }
      for (const Wall& w : all_walls) {
        const double at_wall =
            hertz_time(r, mass, contacts.law(s.material, w.material).young, p.impact_speed);
        if (at_wall < hertz.full)
          hertz.full = at_wall,
          hertz.cause = "Hertz contact of a " + which.str() + " with wall '" + w.name + "'";
      }
    }
    limits.push_back(rayleigh);
    limits.push_back(hertz);
    if (!s.rigid && bonds[t].n_bonds() > 0)
      limits.push_back({"bond vibration of template '" + s.model.name + "'",
                        2 / bonds[t].largest_frequency(s.model), p.bond_fraction, "Bond fraction"});
  }
  return limits;
}

void Dem::check_overlaps() const {
  SeedCloud cloud(store);
  for (int k = 0; k < n_seeds(); ++k) cloud.take(store, k);
  double overlap = 0;
  int seed = -1, other = -1, wall = -1;
  std::vector<int> users_number(n_spheres());
  const std::vector<int> number = sphere_numbers();
  for (std::size_t k = 0; k < number.size(); ++k) users_number[number[k]] = static_cast<int>(k);
  const auto look = [&](double present, int sphere_a, int sphere_b, int w) {
    if (present <= std::max(overlap, 1e-6 * sphere_radius[sphere_a])) return;
    overlap = present, wall = w;
    seed = seed_of_sphere(sphere_a), other = sphere_b < 0 ? -1 : seed_of_sphere(sphere_b);
  };
  for (const SpherePair& p : pairs_within(store, cloud, 0, 0, std::vector<char>(n_seeds(), 1)).pair) {
    const int a = users_number[p.first], b = users_number[p.second];
    look(sphere_radius[a] + sphere_radius[b] - norm(cloud.position(p.first) - cloud.position(p.second)),
         std::min(a, b), std::max(a, b), -1);
  }
  std::vector<WallPoint> points;
  const std::vector<Placement> places = placements(now);
  for (std::size_t w = 0; w < all_walls.size(); ++w)
    for (int k = 0; k < n_spheres(); ++k) {
      points.clear();
      contacts_near(all_walls[w], places[w], cloud.position(number[k]), sphere_radius[k], points);
      for (const WallPoint& p : points) look(sphere_radius[k] - p.distance, k, -1, static_cast<int>(w));
    }
  if (seed < 0) return;
  std::ostringstream text;
  text << "Seed " << seed << " at " << text_of(seed_state(seed).centre) << " starts " << overlap
       << " m inside "
       << (wall >= 0 ? "wall '" + all_walls[wall].name + "'" : "seed " + std::to_string(other))
       << ". Move the seed.";
  throw InputError(text.str());
}

void Dem::check() {
  for (int seed = 0; seed < n_seeds(); ++seed) {
    const Vec3 x = seed_state(seed).centre;
    if (bounded &&
        (x.x < low.x || x.y < low.y || x.z < low.z || x.x > high.x || x.y > high.y || x.z > high.z))
      throw InputError("Seed " + std::to_string(seed) + " starts at " + text_of(x) +
                       ", outside the domain from " + text_of(low) + " to " + text_of(high) +
                       ". Move the seed or enlarge the domain.");
  }
  check_overlaps();
  const std::vector<TimeStepLimit> limits = time_step_limits();
  const auto lowest =
      std::min_element(limits.begin(), limits.end(),
                       [](const TimeStepLimit& a, const TimeStepLimit& b) { return a.step() < b.step(); });
  if (lowest != limits.end() && parameters.time_step > lowest->step()) {
    std::ostringstream text;
    text << "The DEM time step of " << parameters.time_step << " s is above its limit of " << lowest->step()
         << " s (" << lowest->fraction << " of " << lowest->full << " s: " << lowest->cause
         << "). Set 'Time step' to at most " << lowest->step() << " s, use softer material, or raise '"
         << lowest->setting << "' knowingly.";
    throw InputError(text.str());
  }
}

}  // namespace seedflow
