#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "seedflow/experiment/granular_run.h"
#include "seedflow/seeds/region.h"

namespace seedflow {

/// Experiment "slope screening" (Xu et al. 2024, section 3.2.2): seeds rest in a loading area at the upper
/// end of an inclined plate with round holes; the insert plate in front of them is pulled away at 1 m/s; they
/// flow down, fall through the holes into five bins or over the end. Area 1 is the bin next to the loading
/// area.
///
/// Everything is computed in the frame of the plate: x down the slope from the edge of the loading area, y
/// across, z along the plate's normal from its upper face; gravity is inclined instead.
struct SlopeScreening {
  static constexpr int n_areas = 5;

  GranularParameters granular;
  double inclination = 10 * 3.14159265358979323846 / 180;    ///< [rad]
  double length = 300e-3, width = 150e-3, thickness = 1e-3;  ///< of the sieve plate [m]
  double hole = 4.2e-3;                                      ///< diameter [m]
  double pitch = 6e-3;                                       ///< of the holes, staggered rows [m]
  double loading_length = 40e-3;                             ///< of the loading area along the slope [m]
  double loading_steepness = 0;                              ///< of its floor, more than the plate's [rad]
  double insert_speed = 1;                                   ///< [m/s]
  std::string material = "photosensitive resin";

  void declare(Parameters& parameters);
  void check(const Parameters& parameters);

  /// The five bins (regions 0 to 4) and what lies beyond the plate's end (region 5); seeds that come into one
  /// are counted and taken out.
  RegionCensus bins() const;
  /// `census` must outlive the scene.
  GranularScene scene(RegionCensus& census) const;
  int n_holes() const;
  /// Inclined gravity [m/s2].
  Vec3 gravity() const;
  /// Upper end of the loading area's floor: x < 0, z >= 0 [m].
  Vec3 loading_top() const;
};

/// Mass in a region over the mass of all seeds [%].
double percentage(const RegionCensus& census, int region);

namespace screening_reference {
inline constexpr double measured_area_1 = 51.41;   ///< [%]
inline constexpr double simulated_area_1 = 52.19;  ///< [%], the paper's BS 0.075
}  // namespace screening_reference

int run_slope_screening(const RunOptions& options);
void describe_slope_screening(std::ostream& out, const std::string& section);
/// Quantities: passing over area (1 to 5), total passing, over the end, as shares [1].
Observer slope_screening_observer();
int run_slope_screening_study(const RunOptions& options);

}  // namespace seedflow
