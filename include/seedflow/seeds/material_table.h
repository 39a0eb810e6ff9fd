#pragma once

#include <string>
#include <vector>

#include "seedflow/seeds/contact_strengths.h"
#include "seedflow/seeds/material.h"

namespace seedflow {

class Dem;
class Parameters;

/// Sections "Materials" and "Contact pairs" of a .prm: materials by name, and what belongs to each pair.
///
///   subsection Materials
///     set Names = seed, glass                 # any names; the three of the source paper's Table 3 are known
///     set Shear modulus factor = 0.01         # reduced modulus, see below
///     subsection glass
///       set Density = 2500 kg/m3 ...
///     end
///   end
///   subsection Contact pairs
///     subsection seed - glass                 # in the order of Names
///       set Restitution = 0.6 ...
///     end
///   end
///
/// Reduced modulus: all shear moduli times a factor <= 1 lengthen contacts by factor^(-2/5) and allow longer
/// steps; overlaps grow as factor^(-2/5). Restitution and the sliding impulse do not depend on the modulus;
/// what does is anything that feels the overlap or the duration of a contact (bonded seeds, chains of
/// contacts, fast flows). A run with a factor below 1 says so, see notice().
struct MaterialTable {
  struct Pair {
    int a = 0, b = 0;  ///< numbers of the materials, a <= b
    ContactProperties properties;
    bool known = false;  ///< from Table 3 or from the .prm
  };

  std::vector<Material> materials;
  std::vector<Pair> pairs;  ///< every unordered pair, (0, 0), (0, 1), ..., (1, 1), ...
  double shear_modulus_factor = 1;
  ContactStrengths strengths;  ///< entries "Effects/NAME/Strength"

  /// Table 3: seed, photosensitive resin, transparent plexiglass.
  MaterialTable();
  /// Materials of these names; what Table 3 has of them has its values. InputError for an empty, repeated or
  /// unusable name.
  explicit MaterialTable(const std::vector<std::string>& names);
  /// With the names that the file or the overrides give in Materials/Names, Table 3's if they give none:
  /// which entries there are depends on them, so they are needed before declare().
  static MaterialTable named_in(const std::string& file, const std::vector<std::string>& overrides);

  /// Binds to the members: the object must not move until Parameters::read.
  void declare(Parameters& parameters);
  /// After Parameters::read. InputError naming the entries: a material not in Table 3 with a property that is
  /// not given; a pair given in part; a pair of a seed material that is neither known nor given; properties
  /// that contradict each other.
  void check(const Parameters& parameters, const std::vector<std::string>& seed_materials);

  /// Number of the material, the same in a Dem it was applied to. InputError with the nearest name.
  int number(const std::string& name) const;
  const Material& material(const std::string& name) const { return materials[number(name)]; }
  ContactProperties& properties(const std::string& a, const std::string& b);
  /// Adds the materials, with reduced moduli, and sets the known pairs. The Dem must have no materials yet.
  void apply(Dem& dem) const;
  /// Largest overlap over radius when two equal spheres of a material, of any size, meet at this relative
  /// speed [m/s] without damping,
  ///   (delta/R)^(5/2) = 5 sqrt(2) pi/8 rho v^2 (1 - nu)/G,
  /// from m* v^2/2 = 8/15 E* sqrt(R*) delta^(5/2) with the reduced modulus.
  double impact_overlap(int material, double speed) const;
  /// What a reduced modulus does, with the overlap of an impact at 1 m/s, for summary and report; else "".
  std::string notice() const;

 private:
  std::vector<std::string> names() const;
  std::string pair_name(const Pair& pair) const;
  std::vector<std::string> declared_names;  ///< bound to Materials/Names
};

}  // namespace seedflow
