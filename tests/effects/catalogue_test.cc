#include "seedflow/effects/catalogue.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <set>
#include <sstream>

#include "seedflow/effects/device_effects.h"
#include "seedflow/effects/drag_laws.h"

namespace seedflow {
namespace {

/// A state in which every effect of the catalogue acts.
FlowAtBody busy_state() {
  FlowAtBody f;
  f.time_step = 1e-4;
  f.diameter = 1e-3, f.volume = M_PI / 6 * 1e-9, f.mass = 2500 * f.volume, f.sphericity = 0.9;
  f.velocity = {0.01, -0.02, -0.05}, f.angular_velocity = {3, 10, -5}, f.acceleration = {0, 0.5, 1};
  f.flow_velocity = {0.03, 0.01, 0.02}, f.flow_vorticity = {1, -6, 2}, f.flow_acceleration = {0.3, 0.1, 0};
  f.flow_laplacian = {50, 0, -200};
  f.pressure_gradient = {-300, 10, 0};
  f.void_fraction = 0.8, f.density = 1000, f.viscosity = 1e-2, f.gravity = {0, 0, -9.81};
  f.wall_distance = 8e-4, f.wall_normal = {0, 0, 1}, f.tube_diameter = 5e-3;
  return f;
}

bool same_bits(const BodyForce& a, const BodyForce& b) {
  return std::memcmp(&a, &b, sizeof a) == 0;
}

BodyForce base_force() {
  BodyForce b;
  b.drag_coefficient = 1e-4, b.force = {1e-6, -2e-6, 3e-6}, b.torque = {1e-9, 0, 0}, b.added_mass = 1e-7;
  return b;
}

TEST(Catalogue, RecordsAreComplete) {
  std::set<std::string> names;
  for (const auto& definition : effect_catalogue()) {
    const auto& r = definition.record;
    EXPECT_TRUE(names.insert(r.name).second) << r.name;
    for (const auto* text : {&r.slot, &r.summary, &r.equation, &r.validity, &r.signature})
      EXPECT_FALSE(text->empty()) << r.name;
    EXPECT_FALSE(r.references.empty()) << r.name;
    EXPECT_TRUE(r.in_range) << r.name;
    for (const auto& n : r.numbers) {
      EXPECT_GE(n.published, n.range.low) << r.name << n.name;
      EXPECT_LE(n.published, n.range.high) << r.name << n.name;
    }
    for (const auto& c : r.choices)
      EXPECT_NE(std::find(c.options.begin(), c.options.end(), c.standard), c.options.end())
          << r.name << c.name;
  }
}

TEST(Catalogue, StrengthZeroAddsExactlyNothingAndHalfAddsHalf) {
  for (const auto& definition : effect_catalogue()) {
    Effect none(definition), half(definition), full(definition);
    none.set_strength(0), half.set_strength(0.5), full.set_strength(1);
    if (definition.record.name == "Inferred law")  // says nothing until something is inferred
      for (Effect* effect : {&none, &half, &full}) effect->set_number("Coefficient Slip", 1);
    const BodyForce start = base_force();
    BodyForce a = start, b = start, c = start;
    none.add(busy_state(), a), half.add(busy_state(), b), full.add(busy_state(), c);
    EXPECT_TRUE(same_bits(a, start)) << definition.record.name;
    EXPECT_FALSE(same_bits(c, start)) << definition.record.name;
    const double tolerance = 1e-13;
    EXPECT_NEAR(b.drag_coefficient - start.drag_coefficient,
                0.5 * (c.drag_coefficient - start.drag_coefficient), tolerance * c.drag_coefficient);
    EXPECT_NEAR(norm(b.force - start.force - 0.5 * (c.force - start.force)), 0, tolerance * norm(c.force));
    EXPECT_NEAR(b.added_mass - start.added_mass, 0.5 * (c.added_mass - start.added_mass),
                tolerance * c.added_mass);
    EXPECT_FALSE(none.activity().acted());
    EXPECT_TRUE(full.activity().acted());
    EXPECT_EQ(full.activity().evaluations, 1);
  }
}

TEST(Catalogue, StandardSetIsDragAndPressureGradient) {
  EffectSet set;
  const FlowAtBody f = busy_state();
  BodyForce force;
  set.add(f, force);
  EXPECT_EQ(force.drag_coefficient, momentum_exchange(drag_law("Schiller-Naumann"), f));
  EXPECT_EQ(force.added_mass, 0);
  // Archimedes upwards, and with the dynamic pressure gradient downstream
  EXPECT_NEAR(force.force.z, f.volume * 1000 * 9.81, 1e-18);
  EXPECT_NEAR(force.force.x, f.volume * 300, 1e-18);
}

TEST(Catalogue, AnEffectThatIsOnAndDoesNothingIsFound) {
  EffectSet set;
  set["Saffman lift"].set_strength(1);
  FlowAtBody f = busy_state();
  f.flow_vorticity = {};
  BodyForce force;
  EXPECT_TRUE(set.idle().empty());  // not yet evaluated
  set.add(f, force);
  EXPECT_EQ(set.idle(), std::vector<std::string>{"Saffman lift"});
  EXPECT_TRUE(set.out_of_range().empty());
  f.void_fraction = 0.3;
  set["Hindered settling"].set_strength(1);
  set.add(f, force);
  EXPECT_EQ(set.out_of_range(), std::vector<std::string>{"Hindered settling"});
}

TEST(Catalogue, CountingTwiceIsRefused) {
  EffectSet set;
  set["Drag"].set_choice("Law", "Di Felice");
  EXPECT_NO_THROW(set.prepare());
  set["Hindered settling"].set_strength(0.3);
  EXPECT_THROW(set.prepare(), InputError);
  set["Drag"].set_choice("Law", "Haider-Levenspiel");
  EXPECT_NO_THROW(set.prepare());
  set["Nonspherical drag"].set_strength(1);
  EXPECT_THROW(set.prepare(), InputError);
}

TEST(Catalogue, BadInputNamesTheNearest) {
  EffectSet set;
  const auto message = [](auto&& act) -> std::string {
    try {
      act();
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(message([&] { set["Added mas"]; }).find("Added mass"), std::string::npos);
  EXPECT_NE(message([&] { set["Added mass"].set_number("Coeficient", 1); }).find("Coefficient"),
            std::string::npos);
  EXPECT_NE(message([&] { set["Added mass"].set_number("Coefficient", 7); }).find("7"), std::string::npos);
  EXPECT_NE(message([&] { set["History force"].set_choice("Kernel", "Baset"); }).find("Basset"),
            std::string::npos);
  EXPECT_NE(message([&] { set["Drag"].set_strength(2.5); }).find("0 to 2"), std::string::npos);
  std::ostringstream out;
  EXPECT_NE(message([&] { describe_effects(out, "Magnus lft"); }).find("Magnus lift"), std::string::npos);
}

TEST(Catalogue, ListingComesFromTheRecords) {
  std::ostringstream list, one;
  describe_effects(list);
  for (const auto& name : effect_names()) EXPECT_NE(list.str().find(name), std::string::npos);
  describe_effects(one, "Added mass");
  for (const char* part : {"C_A rho V", "Coefficient = 0.5", "10.1017/S0022112088003246", "Valid for"})
    EXPECT_NE(one.str().find(part), std::string::npos) << part;
}

TEST(Catalogue, ParametersSetTheEffects) {
  EffectSet set;
  Parameters parameters;
  set.declare(parameters);
  const std::string file = ::testing::TempDir() + "effects_catalogue_test.prm";
  std::ofstream(file)
      << "subsection Effects\n  subsection Added mass\n    set Strength = 0.75\n    set Coefficient = "
         "0.6\n  end\n  subsection Drag\n    set Law = Rong\n  end\nend\n";
  parameters.read(file, {"Effects/History force/Kernel=Basset"});
  set.prepare();
  EXPECT_EQ(set["Added mass"].settings().strength, 0.75);
  EXPECT_EQ(set["Added mass"].number("Coefficient"), 0.6);
  EXPECT_EQ(set["History force"].choice("Kernel"), "Basset");
  const FlowAtBody f = busy_state();
  BodyForce force;
  set.add(f, force);
  EXPECT_EQ(force.drag_coefficient, momentum_exchange(drag_law("Rong"), f));
  EXPECT_DOUBLE_EQ(force.added_mass, 0.75 * 0.6 * 1000 * f.volume);
}

TEST(Catalogue, SavedMemoryContinuesToTheLastBit) {
  const auto flow = [](int step, int body) {
    FlowAtBody f = busy_state();
    f.body = body, f.time = step * f.time_step;
    f.velocity = {0, 0.01 * body, 0.1 * std::sin(1e-2 * step * (1 + body))};
    return f;
  };
  EffectSet whole, first, second;
  for (auto* set : {&whole, &first, &second}) (*set)["History force"].set_strength(1);
  std::vector<BodyForce> expected;
  for (int step = 0; step < 200; ++step)
    for (int body = 0; body < 3; ++body) {
      BodyForce force, ignored;
      whole.add(flow(step, body), force);
      if (step >= 100) expected.push_back(force);
      if (step < 100) first.add(flow(step, body), ignored);
    }
  std::stringstream file;
  first.save(file);
  second.load(file);
  EffectSet third;  // one body at a time, as when it moves to another rank
  third["History force"].set_strength(1);
  for (int body = 0; body < 3; ++body) third.unpack(body, first.pack(body));
  std::size_t next = 0;
  for (int step = 100; step < 200; ++step)
    for (int body = 0; body < 3; ++body, ++next) {
      BodyForce from_file, from_rank;
      second.add(flow(step, body), from_file);
      third.add(flow(step, body), from_rank);
      EXPECT_TRUE(same_bits(from_file, expected[next]));
      EXPECT_TRUE(same_bits(from_rank, expected[next]));
    }
  EXPECT_EQ(second["History force"].activity().force, whole["History force"].activity().force);
  std::stringstream cut(file.str().substr(0, file.str().size() / 2));
  EXPECT_THROW(third.load(cut), RunError);
}

TEST(Catalogue, TrialEvaluationsLeaveTheMemoryAlone) {
  EffectSet once, often;
  for (auto* set : {&once, &often}) (*set)["History force"].set_strength(1);
  for (int step = 0; step < 20; ++step) {
    FlowAtBody f = busy_state();
    f.time = step * f.time_step, f.velocity.z = 0.01 * step;
    BodyForce a, b, trial;
    once.add(f, a);
    often.add(f, b);
    EXPECT_TRUE(same_bits(a, b));
    f.velocity.z += 0.5;  // the same time again: a trial of the same step
    often.add(f, trial);
  }
  FlowAtBody back = busy_state();
  BodyForce force;
  EXPECT_THROW(once.add(back, force), RunError);  // time went back
  back.time = 1, back.time_step = 0;
  EXPECT_THROW(once.add(back, force), RunError);
}

TEST(Catalogue, KnowsContactsDevicesAndChoicesToo) {
  std::ostringstream list, one;
  describe_effects(list);
  for (const char* name :
       {"Drag", "Rolling friction", "Seal leak", "Disc vibration", "Drag shared per seed",
        "Undisturbed velocity", "Size distribution", "Multi-contact normalisation", "Air drag"})
    EXPECT_NE(list.str().find(name), std::string::npos) << name;
  describe_effects(one, "Suction line loss");
  EXPECT_NE(one.str().find("dp = K rho/2 (Q/A)^2"), std::string::npos);
  std::set<std::string> names;
  for (const EffectRecord& r : all_effect_records()) {
    EXPECT_TRUE(names.insert(r.name).second) << r.name;
    EXPECT_FALSE(r.equation.empty() || r.validity.empty() || r.signature.empty() || r.references.empty())
        << r.name;
    // Either a strength or an entry with two values.
    EXPECT_EQ(r.slot == "choice of the model", !r.entry.path.empty()) << r.name;
    EXPECT_TRUE(r.entry.path.empty() || r.entry.absent != r.entry.present) << r.name;
  }
  std::ostringstream choice;
  describe_effects(choice, "Size distribution");
  EXPECT_NE(choice.str().find("Filling/Diameter deviation = 0.05 x Seeds/Diameter, without the effect 0"),
            std::string::npos)
      << choice.str();
  try {
    describe_effects(choice, "Air drga");
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("Air drag"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace seedflow
