#include "seedflow/seeds/material_table.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "seedflow/base/error.h"
#include "seedflow/base/nearest_name.h"
#include "seedflow/base/parameter_file.h"
#include "seedflow/base/parameters.h"
#include "seedflow/seeds/dem.h"

namespace seedflow {
namespace {

/// The source paper's Table 3. What it gives for a wall belongs to the pair of seed and wall.
struct KnownMaterial {
  Material material;
  double restitution, static_friction, rolling_friction;  ///< in contact with a seed
};

const std::vector<KnownMaterial>& table_3() {
  static const std::vector<KnownMaterial> table{
      {{"seed", 1340, 0.4, 1.5e8}, 0.526, 0.297, 0.03},
      {{"photosensitive resin", 1800, 0.35, 1.3e9}, 0.627, 0.41, 0.026},
      {{"transparent plexiglass", 1600, 0.35, 1.3e9}, 0.643, 0.45, 0.032}};
  return table;
}

const KnownMaterial* known(const std::string& name) {
  for (const KnownMaterial& m : table_3())
    if (m.material.name == name) return &m;
  return nullptr;
}

std::vector<std::string> table_3_names() {
  std::vector<std::string> names;
  for (const KnownMaterial& m : table_3()) names.push_back(m.material.name);
  return names;
}

std::string trimmed(const std::string& s) {
  const auto a = s.find_first_not_of(" \t"), b = s.find_last_not_of(" \t");
  return a == std::string::npos ? "" : s.substr(a, b - a + 1);
}

}  // namespace

MaterialTable::MaterialTable() : MaterialTable(table_3_names()) {}

MaterialTable::MaterialTable(const std::vector<std::string>& names) : declared_names(names) {
  if (names.empty()) throw InputError("Materials/Names is empty. Give at least the material of the seeds.");
  for (const std::string& name : names) {
    if (name.empty() || name.find_first_of("/=#{}") != std::string::npos ||
        name.find(" - ") != std::string::npos)
      throw InputError("Materials/Names: \"" + name +
                       "\" cannot be the name of a material. Use words without / = # { } and \" - \".");
    if (std::count(names.begin(), names.end(), name) > 1)
      throw InputError("Materials/Names: \"" + name + "\" stands there twice. Remove one of them.");
    const KnownMaterial* const m = known(name);
    materials.push_back(m ? m->material : Material{name});
  }
  for (int a = 0; a < static_cast<int>(names.size()); ++a)
    for (int b = a; b < static_cast<int>(names.size()); ++b) {
      Pair pair;
      pair.a = a, pair.b = b;
      const KnownMaterial *const first = known(names[a]), *const second = known(names[b]);
      const KnownMaterial* const other = names[a] == "seed" ? second : names[b] == "seed" ? first : nullptr;
      if (other) {
        pair.known = true;
        pair.properties.restitution = other->restitution;
        pair.properties.static_friction = other->static_friction;
        pair.properties.rolling_friction = other->rolling_friction;
      }
      pairs.push_back(pair);
    }
}

MaterialTable MaterialTable::named_in(const std::string& file, const std::vector<std::string>& overrides) {
  const ParameterLine line = find_parameter_line(file, overrides, "Materials/Names");
  if (line.name.empty()) return MaterialTable();
  std::vector<std::string> names;
  std::istringstream list(line.value);
  for (std::string name; std::getline(list, name, ',');) names.push_back(trimmed(name));
  try {
    return MaterialTable(names);
  } catch (const InputError& error) {
    throw InputError(line.where + ": " + error.what());
  }
}

std::string MaterialTable::pair_name(const Pair& pair) const {
  return materials[pair.a].name + " - " + materials[pair.b].name;
}

void MaterialTable::declare(Parameters& p) {
  strengths.declare(p);
  {
    const auto section = p.section("Materials", "Of seeds and walls.");
    p.texts("Names", declared_names, "Names of the materials, each with a section below.");
    p.number("Shear modulus factor", shear_modulus_factor, "1", Range{0, 1, true},
             "All shear moduli are multiplied by this. Below 1 contacts are softer and last longer, so that "
             "longer steps are allowed; keep overlaps below about 1 % of the radius.");
    for (Material& m : materials) {
      const auto inner = p.section(m.name, "");
      m.declare(p);
    }
  }
  const auto section = p.section("Contact pairs", "What belongs to each pair of materials.");
  for (Pair& pair : pairs) {
    const auto inner = p.section(pair_name(pair), "");
    pair.properties.declare(p);
  }
}

void MaterialTable::check(const Parameters& p, const std::vector<std::string>& seed_materials) {
  for (const Material& m : materials) {
    if (known(m.name)) continue;
    for (const char* entry : {"Density", "Poisson ratio", "Shear modulus"}) {
      const std::string path = "Materials/" + m.name + "/" + entry;
      if (!p.is_set(path))
        throw InputError("The material \"" + m.name + "\" is not one of the known ones (" +
                         table_3_names()[0] + ", " + table_3_names()[1] + ", " + table_3_names()[2] +
                         "), and \"" + path + "\" is not given. Set it.");
    }
  }
  std::vector<int> seeds;
  for (const std::string& name : seed_materials) seeds.push_back(number(name));
  const auto is_seed = [&](int m) { return std::find(seeds.begin(), seeds.end(), m) != seeds.end(); };
  for (Pair& pair : pairs) {
    const std::string section = "Contact pairs/" + pair_name(pair) + "/";
    std::string given, missing;
    for (const char* entry : {"Restitution", "Static friction", "Rolling friction"})
      (p.is_set(section + entry) ? given : missing) += std::string(" \"") + entry + "\"";
    if (!pair.known && !given.empty() && !missing.empty())
      throw InputError("The contact pair \"" + pair_name(pair) + "\" is given in part: \"" +
                       section.substr(0, section.size() - 1) + "\" has" + given + ", but lacks" + missing +
                       ".");
    pair.known = pair.known || !given.empty();
    if (!pair.known && (is_seed(pair.a) || is_seed(pair.b)))
      throw InputError("Nothing is known of the contact pair \"" + pair_name(pair) + "\". Set" + missing +
                       " in \"" + section.substr(0, section.size() - 1) +
                       "\", or remove the material that does not take part from Materials/Names.");
    pair.properties.check("\"" + section.substr(0, section.size() - 1) + "\": ");
    const std::string& cohesion = pair.properties.cohesion;
    if ((cohesion == "JKR" || cohesion == "by strength") && shear_modulus_factor < 1)
      p.reject("Materials/Shear modulus factor",
               "the pair \"" + pair_name(pair) +
                   "\" has JKR cohesion, whose neck and work of separation depend on the modulus",
               "use 1");
  }
}

int MaterialTable::number(const std::string& name) const {
  for (std::size_t m = 0; m < materials.size(); ++m)
    if (materials[m].name == name) return static_cast<int>(m);
  throw InputError("There is no material \"" + name + "\". " + suggestion(name, names(), "material"));
}

std::vector<std::string> MaterialTable::names() const {
  std::vector<std::string> all;
  for (const Material& m : materials) all.push_back(m.name);
  return all;
}

ContactProperties& MaterialTable::properties(const std::string& first, const std::string& second) {
  const int a = number(first), b = number(second);
  return std::find_if(pairs.begin(), pairs.end(),
                      [&](const Pair& p) { return p.a == std::min(a, b) && p.b == std::max(a, b); })
      ->properties;
}

void MaterialTable::apply(Dem& dem) const {
  for (Material m : materials) {
    m.shear_modulus *= shear_modulus_factor;
    dem.add_material(m);
  }
  for (const Pair& pair : pairs)
    if (pair.known) dem.set_contact(pair.a, pair.b, pair.properties.weakened(strengths));
}

double MaterialTable::impact_overlap(int material, double speed) const {
  const Material& m = materials.at(material);
  return std::pow(5 * std::sqrt(2.0) * M_PI / 8 * m.density * speed * speed * (1 - m.poisson_ratio) /
                      (shear_modulus_factor * m.shear_modulus),
                  0.4);
}

std::string MaterialTable::notice() const {
  if (shear_modulus_factor == 1) return "";
  int softest = 0;
  for (int m = 1; m < static_cast<int>(materials.size()); ++m)
    if (impact_overlap(m, 1) > impact_overlap(softest, 1)) softest = m;
  std::ostringstream text;
  text << "Reduced shear moduli: all are " << shear_modulus_factor
       << " times the materials' own; contacts last " << std::pow(shear_modulus_factor, -0.4)
       << " times as long. Restitution and friction do not change. Two spheres of " << materials[softest].name
       << " that meet at 1 m/s overlap by " << std::round(1000 * impact_overlap(softest, 1)) / 10
       << " % of their radius; shapes and packing can be trusted where overlaps stay below 1 %.";
  return text.str();
}

}  // namespace seedflow
