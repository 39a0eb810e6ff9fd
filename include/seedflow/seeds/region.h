#pragma once

#include <iosfwd>
#include <string>
#include <variant>
#include <vector>

#include "seedflow/base/vector.h"

namespace seedflow {

class Dem;

struct BoxRegion {
  Vec3 low, high;  ///< [m]
  bool has(const Vec3& x) const;
};
/// Everything on the side the normal points to.
struct HalfSpaceRegion {
  Vec3 point, normal{0, 0, -1};  ///< [m]
  bool has(const Vec3& x) const { return dot(x - point, normal) >= 0; }
};
struct CylinderRegion {
  Vec3 base, axis{0, 0, 1};       ///< [m]; unit vector after check()
  double radius = 0, length = 0;  ///< [m]
  bool has(const Vec3& x) const;
};
using RegionShape = std::variant<BoxRegion, HalfSpaceRegion, CylinderRegion>;

/// A part of space that seeds are counted in by their centres (bin, outlet, detector).
struct Region {
  enum class Action {
    count,  ///< every seed that comes in is counted once; it goes on
    keep,   ///< a seed belongs to the first such region it comes into (the bins of a sieve); it goes on
    remove  ///< counted and taken out of the simulation (outlets)
  };
  std::string name;
  RegionShape shape;
  Action action = Action::count;

  bool has(const Vec3& x) const;
  /// InputError: no extent, no direction.
  void check();
};

/// The first time that a seed was seen in a region.
struct RegionEntry {
  long label = 0;  ///< Dem::seed_label
  int group = 0;
  double mass = 0;  ///< [kg]
  double time = 0;  ///< [s], of the update that saw it
};

/// Watches the seeds of a Dem: who came into which region and when, takes out what shall go, and notices
/// seeds that are gone for no reason.
///
/// update() after every advance(); a seed that crosses a region between two updates is not seen, so let
/// interval x speed be smaller than the region. Balance: seeds seen so far = present + removed by regions, in
/// number and mass; RunError otherwise, naming what is missing. All ranks do the same.
class RegionCensus {
 public:
  RegionCensus() = default;
  /// InputError for impossible regions or two of one name.
  explicit RegionCensus(std::vector<Region> regions);

  void update(Dem& dem);

  const std::vector<Region>& regions() const { return region; }
  /// In the order of entry.
  const std::vector<RegionEntry>& entries(int which) const { return seen[which]; }
  int n_counted(int which) const { return static_cast<int>(seen[which].size()); }
  double mass_counted(int which) const;
  /// Centres inside at the last update.
  int n_inside(int which) const { return inside[which]; }

  long n_in() const { return n_appeared; }
  long n_removed() const { return n_gone; }
  double mass_in() const { return mass_appeared; }
  double mass_removed() const { return mass_gone; }

  /// Goes on to the last bit after load() into a census of the same regions.
  void save(std::ostream& out) const;
  void load(std::istream& in);

 private:
  std::vector<Region> region;
  std::vector<std::vector<RegionEntry>> seen;  ///< [region]
  std::vector<std::vector<long>> known;        ///< [region] labels seen, sorted
  std::vector<long> kept;                      ///< labels that belong to a region that keeps, sorted
  std::vector<int> inside;
  std::vector<long> present;  ///< labels after the last update, sorted
  long n_appeared = 0, n_gone = 0;
  double mass_appeared = 0, mass_gone = 0;
};

}  // namespace seedflow
