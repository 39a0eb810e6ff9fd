#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "seedflow/seeds/feeder.h"
#include "seedflow/seeds/region.h"

namespace seedflow {

class Parameters;

/// Section "Feeders" of a .prm: a list of names and a subsection for each.
///
///   subsection Feeders
///     set Names = left, right
///     subsection left
///       set Places = random          # random, lattice, list
///       set Low corner = 0, 0, 0
///       set High corner = 50 mm, 10 mm, 60 mm
///       set Mass = 50 g
///       set Templates = seed, broken seed
///       set Shares = 9, 1
///       set First group = 1
///     end
///   end
///
/// Only the entries of the chosen places exist.
class FeederTable {
 public:
  static FeederTable named_in(const std::string& file, const std::vector<std::string>& overrides);
  FeederTable();
  FeederTable(FeederTable&&) noexcept;
  FeederTable& operator=(FeederTable&&) noexcept;
  ~FeederTable();

  void declare(Parameters& parameters);
  /// After Parameters::read. `kinds_of` gives for the name of a template its size classes in the Dem with
  /// their shares (one, unless seeds have a distribution of diameters); InputError for a name it does not
  /// know. Errors: InputError with file and line.
  std::vector<Feeder> build(
      const Parameters& parameters,
      const std::function<std::vector<FeederParameters::Kind>(const std::string&)>& kinds_of) const;
  int size() const { return static_cast<int>(entries.size()); }

 private:
  struct Entry;
  std::vector<std::unique_ptr<Entry>> entries;
  std::unique_ptr<std::vector<std::string>> names;
};

/// Section "Regions" of a .prm, in the same way.
///
///   subsection Regions
///     set Names = bin 1, outlet
///     subsection bin 1
///       set Shape = box              # box, half-space, cylinder
///       set Action = keep            # count, keep, remove
///       set Low corner = 0, 0, -100 mm ...
class RegionTable {
 public:
  static RegionTable named_in(const std::string& file, const std::vector<std::string>& overrides);
  RegionTable();
  RegionTable(RegionTable&&) noexcept;
  RegionTable& operator=(RegionTable&&) noexcept;
  ~RegionTable();

  void declare(Parameters& parameters);
  std::vector<Region> build(const Parameters& parameters) const;
  int size() const { return static_cast<int>(entries.size()); }

 private:
  struct Entry;
  std::vector<std::unique_ptr<Entry>> entries;
  std::unique_ptr<std::vector<std::string>> names;
};

/// A distribution of diameters as n classes of equal number: the mean diameter of each class, relative to the
/// mean of all, for a normal distribution with this relative standard deviation. InputError if the smallest
/// would not be positive.
std::vector<double> size_classes(double relative_deviation, int n);

/// The template enlarged by a factor, density and shape kept.
SeedTemplate scaled(const SeedTemplate& model, double factor);

}  // namespace seedflow
