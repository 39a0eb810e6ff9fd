#pragma once

#include "seedflow/base/device_geometry.h"
#include "seedflow/seeds/dem.h"

namespace seedflow::test {

/// The disc of a device with hole 0 alone, of a soft resin, turning at `speed` [rad/s]; softened seeds stick
/// to it with a restitution of 0.5 and a friction of 0.4. Returns the wall's number; the seeds' material goes
/// to `of_seed`.
inline int add_holed_disc(Dem& dem, const DeviceGeometry& device, double speed, int& of_seed) {
  Material seed, resin{"resin", 1180, 0.38, 1.5e7};
  seed.shear_modulus = 1.5e6;
  of_seed = dem.add_material(seed);
  const int of_disc = dem.add_material(resin);
  dem.set_contact(of_seed, of_disc, {0.5, 0.4, 0.0});
  Plate plate;
  plate.centre = {0, 0, 0.5 * device.thickness};
  plate.normal = {0, 0, -1};
  plate.thickness = device.thickness;
  plate.outline = DiscOutline{device.disc_radius};
  HoleList holes;
  holes.centre = {{device.pitch_radius, 0}};
  plate.holes = holes;
  plate.hole_radius = device.hole_radius();
  plate.chamfer_width = plate.chamfer_depth = device.chamfer;
  return dem.add_wall(Wall("disc", plate, of_disc,
                           speed > 0 ? WallMotion::rotation({0, 0, 0}, {0, 0, speed}) : WallMotion()));
}

}  // namespace seedflow::test
