#include "seedflow/experiment/oblique_impact.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <sstream>

#include "seedflow/base/parameters.h"
#include "seedflow/base/units.h"
#include "seedflow/seeds/dem.h"

namespace seedflow {

namespace {

SeedTemplate sphere_of(const ObliqueImpactParameters& p) {
  SeedTemplate t;
  const double r = p.diameter / 2;
  t.name = "sphere";
  t.position.push_back({});
  t.radius.push_back(r);
  t.seed_volume = 4.0 / 3 * M_PI * r * r * r;
  t.seed_density = p.materials.material(p.sphere_material).density;
  t.seed_semi_axes = Vec3{r, r, r};
  t.finish();
  return t;
}

std::vector<double> standard_angles() {
  std::vector<double> angles;
  for (int degree = 2; degree <= 84; degree += 2) angles.push_back(degree * M_PI / 180);
  return angles;
}

}  // namespace

ObliqueImpactParameters::ObliqueImpactParameters(const std::string& prm,
                                                 const std::vector<std::string>& overrides)
    : angles(standard_angles()),
      materials(prm.empty() ? MaterialTable() : MaterialTable::named_in(prm, overrides)) {}

void ObliqueImpactParameters::declare(Parameters& p) {
  declare_experiment_name(p, name);
  {
    const auto section = p.section("Comparison", "Measured data and the conditions they were taken under.");
    p.file("Measurements", measurements,
           "CSV: condition,quantity,unit,coordinate,coordinate_unit,value,standard_uncertainty. Quantities: "
           "tangential restitution, rebound spin, rebound angle over the impact angle (from the normal). "
           "Empty: nothing to compare with.");
    p.file("Conditions", conditions, "CSV: condition,held_out, and one column per entry that differs.");
  }
  {
    const auto section = p.section("Impact", "A sphere against a plane, without gravity and air.");
    p.text("Sphere material", sphere_material, "One of Materials/Names.");
    p.text("Plane material", plane_material, "One of Materials/Names.");
    p.number("Diameter", diameter, "m", Range::positive(), "Of the sphere.");
    p.number("Speed", speed, "m/s", Range::positive(), "Of the centre before the impact, at every angle.");
    p.numbers("Angles", angles, "rad", Range{0, 1.5707, true},
              "Of the sweep, between path and normal; measured angles are added.");
    p.number("Steps per contact", steps_per_contact, "1", Range{50, 1e6},
             "Time steps in the duration of an elastic normal impact.");
  }
  materials.declare(p);
}

void ObliqueImpactParameters::check(const Parameters& p) {
  materials.check(p, {sphere_material});
  materials.number(plane_material);
  if (measurements.empty() != conditions.empty())
    p.reject(measurements.empty() ? "Comparison/Measurements" : "Comparison/Conditions",
             "measurements and conditions belong together", "give both files or none");
  if (angles.empty()) p.reject("Impact/Angles", "there is no angle", "give at least one, e.g. 45 deg");
}

const ContactProperties& ObliqueImpactParameters::contact() const {
  return const_cast<MaterialTable&>(materials).properties(sphere_material, plane_material);
}

Rebound oblique_impact(const ObliqueImpactParameters& p, double angle) {
  const SeedTemplate sphere = sphere_of(p);
  const double radius = p.diameter / 2, normal_speed = p.speed * std::cos(angle);
  const int plane = p.materials.number(p.plane_material), own = p.materials.number(p.sphere_material);
  DemParameters settings;
  settings.gravity = {};
  const auto reduced = [&](Material m) {
    m.shear_modulus *= p.materials.shear_modulus_factor;
    return m;
  };
  const ContactLaw law(reduced(p.materials.materials[own]), reduced(p.materials.materials[plane]),
                       p.contact());
  const double duration = hertz_time(radius, sphere.mass, law.young, normal_speed);
  settings.time_step = duration / p.steps_per_contact;
  Dem dem(settings);
  p.materials.apply(dem);
  dem.add_template(sphere, own, true);
  dem.add_wall({"plane", {}, {0, 0, 1}, {}, plane});
  dem.add_seed(0, {0, 0, radius}, {}, {p.speed * std::sin(angle), 0, -normal_speed});
  Rebound r;
  SeedState s;
  do {
    dem.advance(settings.time_step);
    s = dem.seed_state(0);
    r.overlap = std::max(r.overlap, radius - s.centre.z);
    if (dem.time() > 20 * duration) {
      std::ostringstream text;
      text << "The sphere does not leave the plane: impact at " << angle * 180 / M_PI
           << " degrees, still in contact after " << dem.time()
           << " s. Cohesion or a low restitution holds it; raise Impact/Speed.";
      throw RunError(text.str());
    }
  } while (s.velocity.z <= 0 || dem.n_contacts() > 0);
  r.contact_time = dem.time();
  r.tangential_restitution = s.velocity.x / (p.speed * std::sin(angle));
  r.normal_restitution = s.velocity.z / normal_speed;
  r.angle = std::atan2(s.velocity.x, s.velocity.z);
  r.spin = s.spin.y;
  return r;
}

double sliding_angle(const ObliqueImpactParameters& p) {
  const ContactProperties& c = p.contact();
  const ContactLaw law(p.materials.material(p.sphere_material), p.materials.material(p.plane_material), c);
  // The surface's speed falls from v_t by 7/2 mu (1 + e) v_n and must stay above mu E*/(6 G*) v_n, at which
  // the spring carries the limit as fast as it grows.
  return std::atan(c.static_friction * (3.5 * (1 + c.restitution) + law.young / (6 * law.shear)));
}

Rebound sliding_rebound(const ObliqueImpactParameters& p, double angle) {
  const ContactProperties& c = p.contact();
  const double impulse = c.static_friction * (1 + c.restitution);
  Rebound r;
  r.tangential_restitution = 1 - impulse / std::tan(angle);
  r.normal_restitution = c.restitution;
  r.angle = std::atan(r.tangential_restitution * std::tan(angle) / c.restitution);
  r.spin = 5 * impulse * p.speed * std::cos(angle) / p.diameter;
  return r;
}

namespace {

PreparedRun prepare(const std::string& prm, const std::vector<std::string>& overrides) {
  /// One reading of the file, with changes.
  struct Reading {
    Reading(const std::string& file, const std::vector<std::string>& all) : impact(file, all) {
      impact.declare(parameters);
      parameters.read(file, all);
      impact.check(parameters);
    }
    ObliqueImpactParameters impact;
    Parameters parameters;
  };
  const auto base = std::make_shared<const Reading>(prm, overrides);
  const auto with = [prm, overrides](const std::vector<std::string>& further) {
    std::vector<std::string> all = overrides;
    all.insert(all.end(), further.begin(), further.end());
    return std::make_shared<const Reading>(prm, all);
  };
  PreparedRun run;
  run.value = [base](const std::string& path) {
    return to_si(base->parameters.value(path), base->parameters.unit(path));
  };
  run.unit = [base](const std::string& path) { return base->parameters.unit(path); };
  run.range = [](const std::string&) {
    return CoordinateRange{1e-6, M_PI / 2 - 1e-6, false, "0 is the head-on impact, 90 degrees a miss."};
  };
  run.simulate = [with](const PreparedRun::Changes& changes, const std::vector<WantedValue>& wanted,
                        MPI_Comm) {
    std::vector<std::string> texts;
    for (const auto& [path, value] : changes) texts.push_back(path + "=" + exact_text(value));
    const auto changed = with(texts);
    std::vector<double> values;
    for (const WantedValue& w : wanted) {
      const Rebound r = oblique_impact(changed->impact, w.coordinate);
      values.push_back(w.quantity == "tangential restitution" ? r.tangential_restitution
                       : w.quantity == "rebound spin"         ? r.spin
                                                              : r.angle);
    }
    return values;
  };
  run.idle_effects = [] { return std::vector<std::string>(); };
  run.parameters_text = [with](const std::vector<std::string>& further) {
    std::ostringstream text;
    with(further)->parameters.write(text);
    return text.str();
  };
  return run;
}

}  // namespace

Observer oblique_impact_observer() {
  Observer observer;
  observer.observables = {{"tangential restitution", "1", "impact angle", "rad",
                           "tangential speed of the centre after the impact over before"},
                          {"rebound spin", "rad/s", "impact angle", "rad", "rotation after the impact"},
                          {"rebound angle", "rad", "impact angle", "rad", "path against normal, after"}};
  // Callipers, high-speed camera.
  observer.uncertainties = {{"diameter of the sphere", "Impact/Diameter", 0.002},
                            {"impact speed", "Impact/Speed", 0.01}};
  observer.prepare = prepare;
  return observer;
}

void describe_oblique_impact(std::ostream& out, const std::string& section) {
  ObliqueImpactParameters input("", {});
  Parameters parameters;
  input.declare(parameters);
  parameters.describe(out, section);
}

}  // namespace seedflow
