#pragma once

#include "seedflow/experiment/curve_fit.h"
#include "seedflow/experiment/view.h"

namespace seedflow {

/// How the angle of repose is read off a picture of a heap.
struct HeapAngleSettings {
  double pixel = 0.1e-3;     ///< edge of a pixel [m]
  double smoothing = 4e-3;   ///< width of the running mean that finds the top, about one seed [m]
  double lowest_part = 0.1;  ///< the flank is fitted between these parts of the heap's height [1]:
  double highest_part = 0.85;
  double layer = 0;  ///< but not below this height: seeds that lie there in one layer have no slope [m]
};

/// A straight flank y = height + slope x fitted to boundary pixels.
struct Flank {
  double angle = 0;           ///< arctan |slope| [rad]
  double standard_error = 0;  ///< of the fit alone [rad]; neighbouring pixels are not independent
  double offset = 0, slope = 0;
  double from = 0, to = 0;  ///< fitted columns [m]
  double rms = 0;           ///< of the boundary about the line [m]
};

struct HeapAngle {
  Flank left, right;
  double mean = 0;    ///< of the two angles [rad]
  double height = 0;  ///< of the heap above its base [m]
  double top = 0;     ///< x of the highest place [m]
  Silhouette::Boundary boundary;
};

/// The angle of repose as the source paper measures it (section 3.2.1): the picture of the heap from the side
/// is turned into black and white, the boundary pixels of both flanks are fitted by a straight line by
/// Levenberg-Marquardt, and the angle is the arctangent of the slope. Columns are chosen where the fitted
/// line (not the noisy boundary) lies between the two parts of the height, so that the choice does not bias
/// the slope; the choice is repeated until it stays. \param base height of the floor in the picture [m].
/// Errors: RunError if the heap is too low or too narrow to have flanks.
HeapAngle heap_angle(const std::vector<Disc>& discs, double base, const HeapAngleSettings& settings);
HeapAngle heap_angle(const Silhouette::Boundary& boundary, double base, const HeapAngleSettings& settings);

}  // namespace seedflow
