#include "seedflow/seeds/wall_parameters.h"

#include <algorithm>

#include "seedflow/base/error.h"
#include "seedflow/base/named_sections.h"
#include "seedflow/base/parameters.h"
#include "wall_entries.h"

namespace seedflow {

struct WallTable::Entry {
  std::string name;
  std::string shape = "plane", material = "seed";
  bool active = true;
  ShapeEntries geometry;
  LawEntries translation, rotation;
  Vec3 direction{0, 0, 1}, axis{0, 0, 1}, pivot;
};

WallTable::WallTable() : names(std::make_unique<std::vector<std::string>>()) {}
WallTable::WallTable(WallTable&&) noexcept = default;
WallTable& WallTable::operator=(WallTable&&) noexcept = default;
WallTable::~WallTable() = default;

WallTable WallTable::named_in(const std::string& file, const std::vector<std::string>& overrides) {
  WallTable table;
  *table.names = listed_names(file, overrides, "Walls/Names", "wall");
  for (const std::string& name : *table.names) {
    auto entry = std::make_unique<Entry>();
    entry->name = name;
    // A value that is not allowed is left to Parameters::read, which says so.
    const auto choose = [&](const std::string& what, std::string& target,
                            const std::vector<std::string>& options) {
      const std::string written = written_value(file, overrides, "Walls/" + name + "/" + what, target);
      if (std::find(options.begin(), options.end(), written) != options.end()) target = written;
    };
    choose("Shape", entry->shape, shape_names());
    choose("Outline", entry->geometry.outline, outline_names());
    choose("Holes", entry->geometry.holes, hole_pattern_names());
    choose("Motion/Translation", entry->translation.kind, law_names());
    choose("Motion/Rotation", entry->rotation.kind, law_names());
    table.entries.push_back(std::move(entry));
  }
  return table;
}

void WallTable::declare(Parameters& p) {
  const auto section = p.section("Walls", "Walls by name, besides those an experiment makes itself.");
  p.texts("Names", *names, "Names of the walls, each with a section below.");
  for (const auto& e : entries) {
    const auto inner = p.section(e->name, "");
    p.choice("Shape", e->shape, shape_names(), "What the wall is; the entries below depend on it.");
    p.text("Material", e->material, "Name of the wall's material.");
    p.flag("Active", e->active, "false: the wall is not there (yet).");
    e->geometry.declare(p, e->shape);
    const auto motion = p.section("Motion", "Of the wall, beginning with the place given above.");
    e->translation.declare(p, "Translation", "Speed", "Amplitude", "m", "m/s", "Displacement");
    if (e->translation.kind != "rest")
      p.vector("Direction", e->direction, "1", Range::any(), "Of the translation.");
    e->rotation.declare(p, "Rotation", "Angular speed", "Angular amplitude", "rad", "rad/s", "Angle");
    if (e->rotation.kind != "rest") {
      p.vector("Axis", e->axis, "1", Range::any(), "Direction of the axis of rotation.");
      p.vector("Pivot", e->pivot, "m", Range::any(), "A point of the axis of rotation.");
    }
  }
}

std::vector<Wall> WallTable::build(const Parameters& p,
                                   const std::function<int(const std::string&)>& material_number) const {
  std::vector<Wall> walls;
  for (const auto& e : entries) {
    const std::string path = "Walls/" + e->name + "/";
    std::string entry = "Material";
    try {
      Wall wall;
      wall.name = e->name;
      wall.active = e->active;
      wall.material = material_number(e->material);
      entry = "Shape";
      wall.surface = e->geometry.surface(e->shape, e->name);
      entry = "Motion/Translation";
      wall.motion.displacement = e->translation.law();
      wall.motion.direction = e->direction;
      entry = "Motion/Rotation";
      wall.motion.angle = e->rotation.law();
      wall.motion.axis = e->axis;
      wall.motion.pivot = e->pivot;
      wall.motion.check(e->name);
      entry = "Shape";
      wall.check();
      walls.push_back(std::move(wall));
    } catch (const InputError& error) {
      p.reject(path + entry, error.what(), "");
    }
  }
  return walls;
}

}  // namespace seedflow
