#pragma once

#include <vector>

#include "seedflow/base/vector.h"

namespace seedflow {

class Parameters;

/// An air-suction seed-metering device: a disc with a ring of holes turns between the seed chamber in front
/// of it and the vacuum chamber behind it.
///
/// Frame: the disc's axis is the z axis; its front (seed) face is z = 0, its back z = thickness; the seed
/// chamber is the annulus in front, z in [-chamber_depth, 0], the vacuum chamber an arc behind,
/// z in [thickness, thickness + vacuum_depth]. Angles count from +x counter-clockwise about +z [rad]; the
/// disc turns in this sense. Gravity is not part of the geometry; -y by custom, so that -90 degrees is the
/// bottom.
///
/// Xu et al. 2024 (Agriculture 14, 752) print the number of holes (by 30 rpm, 10.8 km/h and 0.1 m) and no
/// size; the defaults are usual ones.
struct DeviceGeometry {
  double disc_radius = 100e-3, thickness = 2e-3;  ///< [m]
  int holes = 60;                                 ///< places on the circle
  int drilled = 0;                                ///< how many of them exist, from hole 0 on; 0: all
  double pitch_radius = 90e-3;                    ///< of the circle of holes [m]
  double hole_diameter = 2e-3;                    ///< [m]
  double chamfer = 0.3e-3;                        ///< of the holes on the front, as wide as deep [m]; 0: none
  double first_angle = 0;                         ///< of hole 0 before the disc turns [rad]
  double chamber_inner_radius = 50e-3, chamber_outer_radius = 98e-3, chamber_depth = 20e-3;  ///< [m]
  double vacuum_from = -130 * 3.14159265358979323846 / 180;                                  ///< [rad]
  double vacuum_to = 180 * 3.14159265358979323846 / 180;                                     ///< [rad]
  double vacuum_inner_radius = 82e-3, vacuum_outer_radius = 98e-3, vacuum_depth = 15e-3;     ///< [m]

  /// Section "Device". The object must not move until Parameters::read.
  void declare(Parameters& parameters);
  /// After reading. InputError naming the entry: holes that overlap, a pitch circle outside the disc or the
  /// chambers, a chamfer deeper than the disc, an arc without extent, ...
  void check(const Parameters& parameters) const;

  int n_holes() const { return drilled > 0 ? drilled : holes; }
  /// Angle between neighbouring places [rad].
  double pitch_angle() const;
  /// Of hole k after the disc has turned by `turned` [rad], not reduced to one turn.
  double hole_angle(int k, double turned) const;
  /// Centre of the hole's mouth, on the front face z = 0 [m].
  Vec3 hole_centre(int k, double turned) const;
  double hole_radius() const { return 0.5 * hole_diameter; }
  /// Of the cross section [m2].
  double hole_area() const;
  /// The part of a hole at this angle that the vacuum chamber's arc covers, by area, in [0, 1]; the arc's
  /// ends are radial edges.
  double exposure(double angle) const;
  /// Points along the axes of the holes that face the vacuum, from the front: mouth, middle and end of each
  /// [m].
  std::vector<Vec3> sucking_holes(double turned) const;
};

}  // namespace seedflow
