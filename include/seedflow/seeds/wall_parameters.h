#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "seedflow/seeds/walls.h"

namespace seedflow {

class Parameters;

/// Section "Walls" of a .prm: a list of names and a subsection for each.
///
///   subsection Walls
///     set Names = drum, gate
///     subsection drum
///       set Shape = cylinder       # plane, rectangle, box, cylinder, plate, mesh
///       set Material = photosensitive resin
///       set Radius = 50 mm ...     # what belongs to the shape
///       subsection Motion
///         set Rotation = constant  # rest, constant, ramp, sinusoid, expression
///         set Angular speed = 40 rpm
///         set Axis = 0, 0, 1
///       end
///     end
///   end
///
/// Only the entries of the chosen shape, pattern of holes and motion exist: `./seedflow parameters` of an
/// experiment shows them for the names given.
class WallTable {
 public:
  /// The walls that the file or the overrides name.
  static WallTable named_in(const std::string& file, const std::vector<std::string>& overrides);
  WallTable();
  WallTable(WallTable&&) noexcept;
  WallTable& operator=(WallTable&&) noexcept;
  ~WallTable();

  /// Binds to this object's parts, which stay where they are when it is moved.
  void declare(Parameters& parameters);
  /// After Parameters::read: the walls, their materials as numbers. Errors: InputError with file and line for
  /// shapes and motions that are impossible, files that cannot be read, unknown materials.
  std::vector<Wall> build(const Parameters& parameters,
                          const std::function<int(const std::string&)>& material_number) const;
  int size() const { return static_cast<int>(entries.size()); }

 private:
  struct Entry;
  std::vector<std::unique_ptr<Entry>> entries;
  std::unique_ptr<std::vector<std::string>> names;
};

}  // namespace seedflow
