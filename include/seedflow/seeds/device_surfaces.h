#pragma once

#include <string>

#include "seedflow/base/device_geometry.h"
#include "seedflow/seeds/stl.h"

namespace seedflow {

/// Parts of a seed-metering device as STL files in the coordinates of DeviceGeometry, disc not turned; "" for
/// those made from parameters. Section "Device".
struct DeviceSurfaces {
  std::string disc;     ///< closed
  std::string housing;  ///< what stands, but for the blade
  std::string blade;    ///< stands
  double unit = 1e-3;   ///< what 1 means in the files [m]

  void declare(Parameters& parameters);
  /// After reading: reads the files there are and holds them against the geometry, check_disc() and
  /// check_standing(). InputError naming the entry.
  void check(const DeviceGeometry& geometry, const Parameters& parameters) const;
};

/// Whether a disc has the holes that the geometry says, seen along the axis: around the axis of each a free
/// circle of 0.9 to 1.1 times its radius, with the chamfer in front; beside each (at four of eight places
/// around its mouth at least) and midway between two a front face at z = 0 and a back face at z = thickness,
/// within 5 % of the thickness. Errors: InputError naming `name`, the hole and what was found.
void check_disc(const TriangleSurface& surface, const DeviceGeometry& geometry, const std::string& name);

/// Whether what stands leaves room for the disc: nothing of it inside the disc (by more than 5 % of its
/// thickness) between the seed chamber's inner radius, where a shaft may be, and the rim. Errors: InputError
/// naming `name` and the place.
void check_standing(const TriangleSurface& surface, const DeviceGeometry& geometry, const std::string& name);

}  // namespace seedflow
