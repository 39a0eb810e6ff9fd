#pragma once

#include <iosfwd>
#include <string>

#include "seedflow/experiment/granular_run.h"
#include "seedflow/experiment/heap_angle.h"

namespace seedflow {

/// Experiment "repose angle" (Xu et al. 2024, section 3.2.1): seeds rest in an upper box; the board below
/// them is pulled away at 1 m/s; they fall through the outlet onto the floor, and the angle of the heap is
/// read off its picture from the front. The tester stands between two upright plates, x across the picture, y
/// through it, z up. Sizes are not printed; the defaults are ours, see prm/repose_angle.prm.
struct ReposeAngle {
  GranularParameters granular;
  double box_width = 60e-3, depth = 50e-3;  ///< of the upper box; the depth is that of the whole tester [m]
  double box_height = 120e-3;               ///< [m]
  double outlet = 30e-3;                    ///< width of the outlet in the middle of the box's floor [m]
  double drop = 60e-3;                      ///< from the box's floor to the floor [m]
  double floor_width = 240e-3;              ///< between the end walls [m]
  std::string material = "photosensitive resin", plate_material = "transparent plexiglass";
  double board_speed = 1;  ///< [m/s]
  HeapAngleSettings measuring;

  void declare(Parameters& parameters);
  void check(const Parameters& parameters);
  GranularScene scene() const;
  /// The heap below the outlet.
  HeapAngle measure(const Dem& dem) const;
};

/// What was measured and what the paper's models gave.
namespace repose_reference {
inline constexpr double measured = 28.8, deviation = 1.58;  ///< [degrees], mean and deviation of 3 repeats
}

int run_repose_angle(const RunOptions& options);
void describe_repose_angle(std::ostream& out, const std::string& section);
/// Quantities: angle of repose, angle left, angle right [rad].
Observer repose_angle_observer();
int run_repose_angle_study(const RunOptions& options);

}  // namespace seedflow
