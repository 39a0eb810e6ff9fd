#include "seedflow/seeds/material_table.h"

#include <gtest/gtest.h>

#include <fstream>

#include "seedflow/base/error.h"
#include "seedflow/base/parameters.h"
#include "seedflow/seeds/contact_law.h"
#include "seedflow/seeds/dem.h"

namespace seedflow {
namespace {

/// A table read from a .prm of this text; the test holds the file.
struct ReadTable {
  explicit ReadTable(const std::string& text, const std::vector<std::string>& overrides = {}) {
    const std::string file = testing::TempDir() + "material_table_test.prm";
    std::ofstream(file) << text;
    table = MaterialTable::named_in(file, overrides);
    table.declare(parameters);
    parameters.read(file, overrides);
    table.check(parameters, {"seed"});
  }
  MaterialTable table;
  Parameters parameters;
};

std::string complaint(const std::string& text) {
  try {
    ReadTable table(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

void expect_in(const std::string& text, std::initializer_list<const char*> parts) {
  for (const char* part : parts)
    EXPECT_NE(text.find(part), std::string::npos) << part << "\nnot in: " << text;
}

// Table 3 of the source paper, as printed.
TEST(MaterialTable, Table3) {
  MaterialTable t = ReadTable("").table;
  ASSERT_EQ(t.materials.size(), 3u);
  EXPECT_EQ(t.material("seed").density, 1340);
  EXPECT_EQ(t.material("seed").poisson_ratio, 0.4);
  EXPECT_EQ(t.material("seed").shear_modulus, 1.5e8);
  EXPECT_EQ(t.material("photosensitive resin").density, 1800);
  EXPECT_EQ(t.material("photosensitive resin").shear_modulus, 1.3e9);
  EXPECT_EQ(t.material("transparent plexiglass").density, 1600);
  EXPECT_EQ(t.material("transparent plexiglass").poisson_ratio, 0.35);
  const auto expect = [&](const char* other, double e, double mu, double mu_r) {
    const ContactProperties& p = t.properties(other, "seed");
    EXPECT_EQ(p.restitution, e) << other;
    EXPECT_EQ(p.static_friction, mu) << other;
    EXPECT_EQ(p.rolling_friction, mu_r) << other;
  };
  expect("seed", 0.526, 0.297, 0.03);
  expect("photosensitive resin", 0.627, 0.41, 0.026);
  expect("transparent plexiglass", 0.643, 0.45, 0.032);
  EXPECT_EQ(t.notice(), "");
}

TEST(MaterialTable, OwnMaterialsAndPairsReachTheDem) {
  const ReadTable read(
      "subsection Materials\n set Names = seed, glass\n set Shear modulus factor = 0.01\n"
      " subsection glass\n  set Density = 2500\n  set Poisson ratio = 0.25\n  set Shear modulus = 28 GPa\n "
      "end\n"
      "end\n"
      "subsection Contact pairs\n subsection seed - glass\n  set Restitution = 0.7\n"
      "  set Static friction = 0.2\n  set Rolling friction = 0.01\n end\nend\n");
  Dem dem;
  read.table.apply(dem);
  ASSERT_EQ(dem.materials().size(), 2u);
  EXPECT_EQ(dem.materials()[1].name, "glass");
  EXPECT_DOUBLE_EQ(dem.materials()[0].shear_modulus, 1.5e6);
  EXPECT_DOUBLE_EQ(dem.materials()[1].shear_modulus, 28e7);
  EXPECT_EQ(read.table.pairs[1].properties.restitution, 0.7);
  expect_in(read.table.notice(), {"0.01 times", "6.3"});  // 0.01^(-2/5) = 6.31
}

// Strength 0 leaves the law without the effect, to the last bit; 0.5 halves it.
TEST(MaterialTable, StrengthsScaleTheEffectsOfContacts) {
  ContactProperties p;
  p.cohesion = "JKR";
  p.surface_energy = 0.4;
  p.restitution_law = "viscoelastic";
  ContactStrengths s;
  s.adhesion = s.rolling_friction = s.speed_dependence = 0.5;
  const Material m;
  const ContactLaw full(m, m, p), half(m, m, p.weakened(s));
  EXPECT_EQ(half.rolling_numbers.coefficient, 0.015);
  EXPECT_EQ(half.cohesion_numbers.adhesion, 0.2);
  EXPECT_DOUBLE_EQ(half.viscous_damping, 0.5 * full.viscous_damping);
  s.adhesion = s.rolling_friction = s.speed_dependence = 0;
  const ContactLaw none(m, m, p.weakened(s)), plain(m, m, {});
  EXPECT_EQ(none.cohesion, Cohesion::none);
  EXPECT_EQ(none.rolling, Rolling::none);
  EXPECT_EQ(none.viscous_damping, 0);
  EXPECT_EQ(none.normal_damping, plain.normal_damping);
  p = {};
  p.tangential_model = "Mindlin with partial slip";
  s = {};
  s.partial_slip = 0;
  EXPECT_EQ(ContactLaw(m, m, p.weakened(s)).partial_slip, 0);
  p = {};
  p.cohesion = "capillary bridge";
  p.surface_tension = 0.07;
  p.bridge_volume = 1e-11;
  s.liquid_bridges = 0;
  EXPECT_EQ(ContactLaw(m, m, p.weakened(s)).cohesion, Cohesion::none);
}

TEST(MaterialTable, NamesFromAnOverride) {
  EXPECT_EQ(ReadTable("", {"Materials/Names=seed, photosensitive resin"}).table.materials.size(), 2u);
}

TEST(MaterialTable, MissingAndContradictoryEntriesAreNamed) {
  const std::string glass = "subsection Materials\n set Names = seed, glass\nend\n";
  expect_in(complaint(glass), {"\"glass\"", "\"Materials/glass/Density\""});
  const std::string complete =
      "subsection Materials\n set Names = seed, glass\n subsection glass\n  set Density = 2500\n"
      "  set Poisson ratio = 0.25\n  set Shear modulus = 28e9\n end\nend\n";
  expect_in(complaint(complete), {"\"seed - glass\"", "Contact pairs/seed - glass", "Restitution"});
  expect_in(complaint(complete + "subsection Contact pairs\n subsection seed - glass\n"
                                 "  set Restitution = 0.7\n end\nend\n"),
            {"in part", "has \"Restitution\"", "lacks \"Static friction\" \"Rolling friction\""});
  expect_in(complaint("subsection Contact pairs\n subsection photosensitive resin - seed\n"
                      "  set Restitution = 0.7\n end\nend\n"),
            {"not known", "seed - photosensitive resin"});
  expect_in(complaint("subsection Materials\n set Names = seed, seed\nend\n"), {"twice", ".prm:2"});
  expect_in(complaint("subsection Materials\n set Names = seed, a/b\nend\n"), {"\"a/b\" cannot be"});
  expect_in(complaint("subsection Contact pairs\n subsection seed - seed\n  set Cohesion = JKR\n end\nend\n"),
            {"Contact pairs/seed - seed", "'Surface energy' is 0"});
  expect_in(
      complaint("subsection Materials\n set Shear modulus factor = 0.1\nend\nsubsection Contact pairs\n"
                " subsection seed - seed\n  set Cohesion = JKR\n  set Surface energy = 0.1\n end\nend\n"),
      {"Shear modulus factor", "JKR"});
  expect_in(
      complaint("subsection Contact pairs\n subsection seed - seed\n  set Restitution = 1.5\n end\nend\n"),
      {"Restitution", "1.5", ".prm:3"});
}

}  // namespace
}  // namespace seedflow
