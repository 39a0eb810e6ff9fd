#include "seedflow/seeds/feeder_parameters.h"

#include <algorithm>

#include "seedflow/base/error.h"
#include "seedflow/base/named_sections.h"
#include "seedflow/base/parameters.h"

namespace seedflow {
namespace {

const std::vector<std::string> place_names{"random", "lattice", "list"};

}  // namespace

struct FeederTable::Entry {
  FeederParameters feeder;
  std::string places = "random", file;
  Vec3 low, high;
  double spacing = 0, jitter = 0.5;
  int tries = 2000;
  std::vector<std::string> templates{"seed"};
  std::vector<double> shares;
};

FeederTable::FeederTable() : names(std::make_unique<std::vector<std::string>>()) {}
FeederTable::FeederTable(FeederTable&&) noexcept = default;
FeederTable& FeederTable::operator=(FeederTable&&) noexcept = default;
FeederTable::~FeederTable() = default;

FeederTable FeederTable::named_in(const std::string& file, const std::vector<std::string>& overrides) {
  FeederTable table;
  *table.names = listed_names(file, overrides, "Feeders/Names", "feeder");
  for (const std::string& name : *table.names) {
    auto e = std::make_unique<Entry>();
    e->feeder.name = name;
    const std::string written = written_value(file, overrides, "Feeders/" + name + "/Places", e->places);
    if (std::find(place_names.begin(), place_names.end(), written) != place_names.end()) e->places = written;
    table.entries.push_back(std::move(e));
  }
  return table;
}

void FeederTable::declare(Parameters& p) {
  const auto section = p.section("Feeders", "Where seeds come from.");
  p.texts("Names", *names, "Names of the feeders, each with a section below.");
  for (const auto& e : entries) {
    FeederParameters& f = e->feeder;
    const auto inner = p.section(f.name, "");
    p.choice("Places", e->places, place_names, "How places are found; the entries below depend on it.");
    if (e->places == "list") {
      p.file("File", e->file,
             "CSV with the columns x, y, z (m) and, if wanted, qw, qx, qy, qz, vx, vy, vz, group, kind.");
    } else {
      p.vector("Low corner", e->low, "m", Range::any(), "Of the box that holds the seeds when they are fed.");
      p.vector("High corner", e->high, "m", Range::any(),
               "Of the box that holds the seeds when they are fed.");
      p.vector("Velocity", f.velocity, "m/s", Range::any(), "Of new seeds.");
      p.flag("Random orientation", f.random_orientation, "false: as the template stands.");
      p.numbers("Group shares", f.group_shares, "1", Range::non_negative(),
                "Share of each group (colour) in the number of seeds.");
      p.integer("First group", f.first_group, Range::non_negative(), "Number of the first of these groups.");
    }
    if (e->places == "lattice") {
      p.number("Spacing", e->spacing, "m", Range::non_negative(),
               "Between places; 0: the closest at which seeds do not touch.");
      p.number("Jitter", e->jitter, "1", Range::between(0, 1),
               "Random shift as a part of what keeps neighbours apart.");
    }
    if (e->places == "random")
      p.integer("Tries", e->tries, Range{1, 1e9}, "For one seed before the feeder counts as full.");
    p.texts("Templates", e->templates, "Names of the seeds it feeds.");
    p.numbers("Shares", e->shares, "1", Range::non_negative(),
              "Share of each template in the number of seeds; empty: equal.");
    p.integer("Number", f.number, Range::non_negative(), "Of seeds; 0: see Mass.");
    p.number("Mass", f.mass, "kg", Range::non_negative(), "Of all seeds, as near as whole seeds allow.");
    p.number("Rate", f.rate, "kg/s", Range::non_negative(), "0: all at once.");
    p.number("Start", f.start, "s", Range::non_negative(), "When it begins to feed.");
    p.flag("As room permits", f.as_room_permits, "Feeds on as room permits; false: being full is an error.");
    p.number("Patience", f.patience, "s", Range::positive(), "So long it may find no room.");
    p.integer("Random number", f.random_number, Range::non_negative(), "Another one gives other seeds.");
  }
}

std::vector<Feeder> FeederTable::build(
    const Parameters& p,
    const std::function<std::vector<FeederParameters::Kind>(const std::string&)>& kinds_of) const {
  std::vector<Feeder> feeders;
  for (const auto& e : entries) {
    std::string entry = "Templates";
    const std::string path = "Feeders/" + e->feeder.name + "/";
    try {
      FeederParameters f = e->feeder;
      if (!e->shares.empty() && e->shares.size() != e->templates.size())
        throw InputError("there are " + std::to_string(e->templates.size()) + " templates, but " +
                         std::to_string(e->shares.size()) + " shares. Give one for each or none.");
      for (std::size_t t = 0; t < e->templates.size(); ++t) {
        std::vector<FeederParameters::Kind> kinds = kinds_of(e->templates[t]);
        double sum = 0;
        for (const auto& kind : kinds) sum += kind.share;
        for (auto& kind : kinds) {
          kind.share *= (e->shares.empty() ? 1 : e->shares[t]) / sum;
          f.kinds.push_back(kind);
        }
      }
      entry = e->places == "list" ? "File" : "Places";
      if (e->places == "list")
        f.places = read_places(e->file);
      else if (e->places == "lattice")
        f.places = LatticePlaces{e->low, e->high, e->spacing, e->jitter};
      else
        f.places = RandomPlaces{e->low, e->high, e->tries};
      entry = "Places";
      feeders.emplace_back(std::move(f));
    } catch (const InputError& error) {
      p.reject(path + entry, error.what(), "");
    }
  }
  return feeders;
}

}  // namespace seedflow
