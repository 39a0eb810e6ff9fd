#pragma once

#include <string>

#include "seedflow/base/parameters.h"
#include "seedflow/seeds/seed_template.h"
#include "seedflow/seeds/shape.h"

namespace seedflow {

/// What a user says about the model of one kind of seed. The defaults are the paper's seed (section 3.1) with
/// its BS = 0.1 model (Table 2): 70 sub-spheres in a 4 mm sphere.
struct SeedTemplateParameters {
  std::string shape = "sphere";            ///< sphere | ellipsoid | stl | csv
  double diameter = 4e-3;                  ///< of the sphere with the seed's volume [m]
  double sphericity = 0.976;               ///< of the ellipsoid [1]
  std::string sphericity_kind = "axes";    ///< axes | surface
  std::string ellipsoid_kind = "prolate";  ///< prolate | oblate
  double density = 1340;                   ///< of the real seed [kg/m3]
  int n_spheres = 70;
  std::string reading = "radius";  ///< of Table 2's printed sizes: radius | diameter
  double sphere_radius = 0;        ///< [m]; 0: from Table 2
  double contact_factor = 0;       ///< contact radius / sub-sphere radius; 0: automatic
  double bond_factor = 1;          ///< bond radius / radius of the smaller sub-sphere
  bool equal_caliper = false;      ///< enlarge the clump to the mean caliper of the real seed
  bool real_inertia = false;       ///< shift mass between sub-spheres to the real seed's inertia
  int random_number = 1;
  std::string file;  ///< of shape stl or csv

  void declare(Parameters& parameters);
  /// After reading: rejects (InputError with file and line) entries of `section` ("Seeds", "Seeds/Pellet",
  /// ...) that have no effect with this shape but differ from the `defaults` they were declared with, and a
  /// shape from a file without the file.
  void check(const Parameters& parameters, const std::string& section,
             const SeedTemplateParameters& defaults) const;
};

/// The shape these parameters describe. Errors: InputError (an STL that is unreadable or not closed, ...).
Shape make_shape(const SeedTemplateParameters& parameters);

/// Radius of the sub-spheres [m]: the given one, or the paper's surface roughness BS (Table 2) times the
/// diameter, read as radius or as diameter. For a number that is not in Table 2: the radius at which the
/// sub-spheres' volumes add up to 0.56 of the seed (the fill of all five models in the radius reading), in
/// the diameter reading half of it. One sub-sphere is the inscribed sphere.
double sub_sphere_radius(const SeedTemplateParameters& parameters, const Shape& shape);

/// Packs, bonds and finishes a template. The same parameters give the same template, bit by bit.
/// Errors: InputError if the parameters do not make one connected seed: what, allowed, remedy.
SeedTemplate make_seed_template(const SeedTemplateParameters& parameters);

/// The paper's five models (Table 2) by their number of sub-spheres, and the printed size over the seed's
/// diameter.
struct PaperModel {
  int n_spheres;
  double roughness;  ///< BS [1]
};
inline constexpr PaperModel paper_models[] = {
    {36, 0.125}, {50, 0.1125}, {70, 0.1}, {109, 0.0875}, {164, 0.075}};

}  // namespace seedflow
