// Section "Regions" of a .prm.

#include <algorithm>

#include "seedflow/base/error.h"
#include "seedflow/base/named_sections.h"
#include "seedflow/base/parameters.h"
#include "seedflow/seeds/feeder_parameters.h"

namespace seedflow {
namespace {

const std::vector<std::string> shape_names{"box", "half-space", "cylinder"};

}  // namespace

struct RegionTable::Entry {
  std::string name, shape = "box", action = "count";
  Vec3 low, high, point, direction{0, 0, 1};
  double radius = 0, length = 0;
};

RegionTable::RegionTable() : names(std::make_unique<std::vector<std::string>>()) {}
RegionTable::RegionTable(RegionTable&&) noexcept = default;
RegionTable& RegionTable::operator=(RegionTable&&) noexcept = default;
RegionTable::~RegionTable() = default;

RegionTable RegionTable::named_in(const std::string& file, const std::vector<std::string>& overrides) {
  RegionTable table;
  *table.names = listed_names(file, overrides, "Regions/Names", "region");
  for (const std::string& name : *table.names) {
    auto e = std::make_unique<Entry>();
    e->name = name;
    const std::string written = written_value(file, overrides, "Regions/" + name + "/Shape", e->shape);
    if (std::find(shape_names.begin(), shape_names.end(), written) != shape_names.end()) e->shape = written;
    table.entries.push_back(std::move(e));
  }
  return table;
}

void RegionTable::declare(Parameters& p) {
  const auto section = p.section("Regions", "Parts of space that count seeds, keep them or take them out.");
  p.texts("Names", *names, "Names of the regions, each with a section below.");
  for (const auto& e : entries) {
    const auto inner = p.section(e->name, "");
    p.choice("Shape", e->shape, shape_names, "The entries below depend on it.");
    p.choice(
        "Action", e->action, {"count", "keep", "remove"},
        "count: every seed that comes in, once; keep: it belongs to the first such region; remove: it is "
        "counted and taken out.");
    if (e->shape == "box") {
      p.vector("Low corner", e->low, "m", Range::any(), "Of the box.");
      p.vector("High corner", e->high, "m", Range::any(), "Of the box.");
    } else if (e->shape == "half-space") {
      p.vector("Point", e->point, "m", Range::any(), "Any point of the plane.");
      p.vector("Normal", e->direction, "1", Range::any(), "Into the region.");
    } else {
      p.vector("Base", e->point, "m", Range::any(), "Centre of one end.");
      p.vector("Axis", e->direction, "1", Range::any(), "From the base to the other end.");
      p.number("Radius", e->radius, "m", Range::non_negative(), "Of the cylinder.");
      p.number("Length", e->length, "m", Range::non_negative(), "Of the cylinder.");
    }
  }
}

std::vector<Region> RegionTable::build(const Parameters& p) const {
  std::vector<Region> regions;
  for (const auto& e : entries) {
    Region r;
    r.name = e->name;
    r.action = e->action == "count"  ? Region::Action::count
               : e->action == "keep" ? Region::Action::keep
                                     : Region::Action::remove;
    if (e->shape == "box")
      r.shape = BoxRegion{e->low, e->high};
    else if (e->shape == "half-space")
      r.shape = HalfSpaceRegion{e->point, e->direction};
    else
      r.shape = CylinderRegion{e->point, e->direction, e->radius, e->length};
    try {
      r.check();
    } catch (const InputError& error) {
      p.reject("Regions/" + e->name + "/Shape", error.what(), "");
    }
    regions.push_back(std::move(r));
  }
  return regions;
}

}  // namespace seedflow
