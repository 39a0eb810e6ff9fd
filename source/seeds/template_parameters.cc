#include "seedflow/seeds/template_parameters.h"

#include <algorithm>
#include <cmath>

#include "seedflow/seeds/caliper.h"
#include "seedflow/seeds/packing.h"
#include "seedflow/seeds/shape_spheroid.h"
#include "seedflow/seeds/stl.h"
#include "seedflow/seeds/template_bonds.h"
#include "seedflow/seeds/template_file.h"
#include "seedflow/seeds/template_inertia.h"

namespace seedflow {

void SeedTemplateParameters::declare(Parameters& parameters) {
  parameters.choice(
      "Shape", shape, {"sphere", "ellipsoid", "stl", "csv"},
      "Outer shape of the real seed. sphere: a ball of Diameter. ellipsoid: an ellipsoid with the volume "
      "of that ball and the given Sphericity. stl: a closed surface read from File, scaled to the volume "
      "of that ball (an STL file has no unit). csv: a finished template read from File, which then "
      "states all of it: nothing else may then be set here.");
  parameters.number(
      "Diameter", diameter, "m", Range::positive(),
      "Diameter of the sphere with the volume of the real seed. The paper's seed: 4.0 +- 0.1 mm.");
  parameters.number("Sphericity", sphericity, "1", {0.3, 1.0, false},
                    "Of the ellipsoid, 1 being a sphere. The paper's seed: 0.976.");
  parameters.choice(
      "Sphericity kind", sphericity_kind, {"axes", "surface"},
      "How the sphericity was measured. axes: (a b c)^(1/3) / a with the three semi-axes, a the longest "
      "(Mohsenin's degree of sphericity, read off with a caliper, the habit with seeds). surface: surface "
      "of the sphere of equal volume over the seed's surface (Wadell). The paper does not say which; "
      "0.976 means a seed 3.7 % longer than thick by axes, 47 % longer by surface (prolate).");
  parameters.choice("Ellipsoid kind", ellipsoid_kind, {"prolate", "oblate"},
                    "prolate: two equal short axes (a grain). oblate: two equal long axes (a lentil).");
  parameters.number(
      "Density", density, "kg/m3", Range::positive(),
      "Of the real seed. The sub-spheres' density follows from it so that the mass is exact (Eq. 9).");
  parameters.integer(
      "Sub-spheres", n_spheres, {1.0, 100000.0, false},
      "Number N of sub-spheres. The paper's models: 36, 50, 70, 109, 164. 1 is a plain sphere.");
  parameters.choice(
      "Reading", reading, {"radius", "diameter"},
      "What Table 2's printed 0.5 ... 0.3 mm are. radius: they fill 56 % of the seed, touch, and give "
      "the printed numbers of sub-spheres. diameter: as the text says; they fill 7 %, cannot touch, and "
      "bonds need a contact radius of more than twice their own.");
  parameters.number(
      "Sub-sphere radius", sphere_radius, "m", Range::non_negative(),
      "0: from Table 2, in the chosen reading and in proportion to Diameter; for another N such that "
      "the sub-spheres' volumes add up to 56 % of the seed (7 % in the diameter reading).");
  parameters.number(
      "Contact radius factor", contact_factor, "1", Range::non_negative(),
      "Two sub-spheres are bonded when their centres are nearer than the sum of their contact radii; "
      "this is contact radius over radius. 0: 1.1 times the radius or, where the sub-spheres "
      "are spread apart, 1.1 times half the distance of the nearest two.");
  parameters.number(
      "Bond radius factor", bond_factor, "1", Range::positive(),
      "Radius of a bond over the radius of the smaller of its two sub-spheres. Bond stiffness is the "
      "stiffness per area times pi R_b^2. The paper does not print it; 1 is the usual choice.");
  parameters.flag(
      "Equal mean caliper", equal_caliper,
      "Enlarge the clump until its mean caliper (width averaged over all directions) is the real seed's. "
      "Otherwise a coarse clump is a smaller seed: 3.89 mm for N = 36 instead of 4 mm, and falls through "
      "holes more easily for that reason alone.");
  parameters.flag(
      "Real inertia", real_inertia,
      "Shift mass between the sub-spheres, as little as possible, until centre of mass and moments of "
      "inertia are those of the real homogeneous seed. Otherwise all sub-spheres have one density (Eq. 9).");
  parameters.integer("Random number", random_number, {0.0, 2147483647.0, false},
                     "Start of the random packing. The same number gives the same template, bit by bit.");
  parameters.file("File", file, "The STL surface or the CSV template, for those two shapes.");
}

void SeedTemplateParameters::check(const Parameters& parameters, const std::string& section,
                                   const SeedTemplateParameters& defaults) const {
  const bool from_file = shape == "stl" || shape == "csv";
  if (from_file && file.empty())
    parameters.reject(section + "/File", "Shape = " + shape + " is read from a file, but none is given",
                      "set File to the name of the " + shape + " file");
  const auto unused = [&](const char* entry, const auto& value, const auto& declared) {
    if (value != declared)
      parameters.reject(section + "/" + entry, "it has no effect with Shape = " + shape,
                        "remove it, or choose another Shape");
  };
  if (!from_file) unused("File", file, defaults.file);
  if (shape != "ellipsoid") {
    unused("Sphericity", sphericity, defaults.sphericity);
    unused("Sphericity kind", sphericity_kind, defaults.sphericity_kind);
    unused("Ellipsoid kind", ellipsoid_kind, defaults.ellipsoid_kind);
  }
  if (shape != "csv") return;
  unused("Diameter", diameter, defaults.diameter);
  unused("Density", density, defaults.density);
  unused("Sub-spheres", n_spheres, defaults.n_spheres);
  unused("Reading", reading, defaults.reading);
  unused("Sub-sphere radius", sphere_radius, defaults.sphere_radius);
  unused("Contact radius factor", contact_factor, defaults.contact_factor);
  unused("Bond radius factor", bond_factor, defaults.bond_factor);
  unused("Equal mean caliper", equal_caliper, defaults.equal_caliper);
  unused("Real inertia", real_inertia, defaults.real_inertia);
  unused("Random number", random_number, defaults.random_number);
}

namespace {

SphericityKind sphericity_kind_of(const std::string& name) {
  if (name == "axes") return SphericityKind::axes;
  if (name == "surface") return SphericityKind::surface;
  throw InputError("Seed template: sphericity kind '" + name + "' is unknown; allowed: axes, surface.");
}

SpheroidKind spheroid_kind_of(const std::string& name) {
  if (name == "prolate") return SpheroidKind::prolate;
  if (name == "oblate") return SpheroidKind::oblate;
  throw InputError("Seed template: ellipsoid kind '" + name + "' is unknown; allowed: prolate, oblate.");
}

/// Share of the sphere with the seed's volume that the paper's models fill in the radius reading, N (r/R)^3:
/// 0.55 to 0.58 for the five, 0.56 for the recommended one.
constexpr double paper_fill = 0.56;

/// Sub-spheres enlarged together about the shape's centre.
void enlarge(SeedTemplate& seed, double factor) {
  for (Vec3& x : seed.position) x *= factor;
  for (double& r : seed.radius) r *= factor;
}

}  // namespace

Shape make_shape(const SeedTemplateParameters& p) {
  if (p.shape == "sphere") return sphere_shape(p.diameter);
  if (p.shape == "ellipsoid")
    return ellipsoid_shape(spheroid_semi_axes(p.diameter, p.sphericity, sphericity_kind_of(p.sphericity_kind),
                                              spheroid_kind_of(p.ellipsoid_kind)));
  if (p.shape == "stl") return surface_shape(read_stl(p.file), p.diameter);
  throw InputError("Seed template: no sub-spheres are packed into shape '" + p.shape +
                   "'; allowed: sphere, ellipsoid, stl.");
}

double sub_sphere_radius(const SeedTemplateParameters& p, const Shape& shape) {
  if (p.reading != "radius" && p.reading != "diameter")
    throw InputError("Seed template: reading '" + p.reading + "' is unknown; allowed: radius, diameter.");
  if (p.sphere_radius > 0) return p.sphere_radius;
  if (p.n_spheres == 1) return shape.inscribed_radius;
  double size = 0.5 * std::cbrt(paper_fill / p.n_spheres);
  for (const PaperModel& model : paper_models)
    if (model.n_spheres == p.n_spheres) size = model.roughness;
  return size * p.diameter * (p.reading == "diameter" ? 0.5 : 1.0);
}

SeedTemplate make_seed_template(const SeedTemplateParameters& p) {
  if (p.shape == "csv") return read_template(p.file);
  const Shape shape = make_shape(p);
  const double radius = sub_sphere_radius(p, shape);
  const Packing packing = pack_spheres(shape, p.n_spheres, radius, p.random_number);

  SeedTemplate seed;
  seed.name = p.shape + "-" + std::to_string(p.n_spheres);
  seed.position = packing.centre;
  seed.radius.assign(p.n_spheres, radius);
  seed.seed_volume = shape.volume;
  seed.seed_density = p.density;
  seed.seed_semi_axes = shape.semi_axes;
  if (p.equal_caliper) enlarge(seed, caliper(shape).mean / caliper(seed).mean);
  const double spread = std::max(1.0, packing.smallest_distance / (2 * radius));
  bond_by_contact_radius(seed, p.contact_factor > 0 ? p.contact_factor : 1.1 * spread, p.bond_factor);
  require_one_piece(seed);
  if (p.real_inertia) match_real_inertia(seed, shape);
  seed.finish();
  return seed;
}

}  // namespace seedflow
