#include "seedflow/experiment/heap_angle.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "seedflow/base/error.h"

namespace seedflow {

namespace {

/// Mean of the boundary within half a width of every column.
std::vector<double> running_mean(const Silhouette::Boundary& b, double width) {
  std::vector<double> mean(b.x.size());
  std::size_t first = 0, last = 0;
  double sum = 0;
  for (std::size_t i = 0; i < b.x.size(); ++i) {
    while (last < b.x.size() && b.x[last] <= b.x[i] + 0.5 * width) sum += b.y[last++];
    while (b.x[first] < b.x[i] - 0.5 * width) sum -= b.y[first++];
    mean[i] = sum / static_cast<double>(last - first);
  }
  return mean;
}

/// \param side -1: left of the top, +1: right of it.
Flank fit_flank(const Silhouette::Boundary& b, int side, double base, double height, double top,
                const HeapAngleSettings& settings) {
  const double low = base + std::max(settings.lowest_part * height, settings.layer),
               high = base + settings.highest_part * height;
  const auto fit = [&](double from, double to) {
    std::vector<double> x, y;
    for (std::size_t i = 0; i < b.x.size(); ++i)
      if (b.x[i] >= from && b.x[i] <= to) x.push_back(b.x[i] - top), y.push_back(b.y[i] - base);
    if (x.size() < 10)
      throw RunError(std::string("The ") + (side < 0 ? "left" : "right") + " flank of the heap is only " +
                     std::to_string(x.size()) +
                     " pixels wide: no angle can be fitted. Use more seeds, smaller pixels, or a floor on "
                     "which the heap stays.");
    const CurveFit line = fit_line(x, y);
    Flank flank;
    flank.slope = line.parameters[1];
    flank.offset = base + line.parameters[0] - flank.slope * top;
    flank.angle = std::atan(-side * flank.slope);
    flank.standard_error = line.standard_error[1] / (1 + flank.slope * flank.slope);
    flank.from = from, flank.to = to, flank.rms = line.rms;
    return flank;
  };
  // The first guess: from the top outwards until the boundary is below the lower part for good.
  const std::vector<double> smooth = running_mean(b, settings.smoothing);
  double near = top, far = top;
  for (std::size_t k = 0; k < b.x.size(); ++k) {
    const std::size_t i = side > 0 ? k : b.x.size() - 1 - k;
    const double out = side * (b.x[i] - top);
    if (out < 0) continue;
    if (smooth[i] >= high) near = b.x[i];
    far = b.x[i];
    if (smooth[i] <= low) break;
  }
  Flank flank = fit(std::min(near, far), std::max(near, far));
  for (int pass = 0; pass < 20; ++pass) {
    if (!(flank.angle > 0)) break;
    const double at_high = (high - flank.offset) / flank.slope, at_low = (low - flank.offset) / flank.slope;
    const double from = std::min(at_high, at_low), to = std::max(at_high, at_low);
    const bool stays =
        std::abs(from - flank.from) < settings.pixel && std::abs(to - flank.to) < settings.pixel;
    flank = fit(from, to);
    if (stays) break;
  }
  return flank;
}

}  // namespace

HeapAngle heap_angle(const Silhouette::Boundary& boundary, double base, const HeapAngleSettings& settings) {
  if (boundary.x.empty()) throw RunError("There is no heap in the picture: no angle of repose.");
  HeapAngle heap;
  heap.boundary = boundary;
  const std::vector<double> smooth = running_mean(boundary, settings.smoothing);
  const auto highest = std::max_element(smooth.begin(), smooth.end());
  heap.height = *highest - base;
  heap.top = boundary.x[static_cast<std::size_t>(highest - smooth.begin())];
  if (!(heap.height > 2 * settings.smoothing))
    throw RunError("The heap is " + std::to_string(heap.height) +
                   " m high, less than two seeds: it has no flanks, and no angle of repose.");
  heap.left = fit_flank(boundary, -1, base, heap.height, heap.top, settings);
  heap.right = fit_flank(boundary, +1, base, heap.height, heap.top, settings);
  heap.mean = 0.5 * (heap.left.angle + heap.right.angle);
  return heap;
}

HeapAngle heap_angle(const std::vector<Disc>& discs, double base, const HeapAngleSettings& settings) {
  Silhouette picture(window_of(discs, settings.pixel), settings.pixel);
  for (const Disc& disc : discs) picture.add(disc);
  return heap_angle(picture.upper_boundary(), base, settings);
}

}  // namespace seedflow
