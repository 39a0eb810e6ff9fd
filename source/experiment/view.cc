#include "seedflow/experiment/view.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "seedflow/base/error.h"

namespace seedflow {

namespace {

/// First and last pixel, of n, whose centre lies in [low, high].
struct Span {
  int first, last;
};
Span span(double low, double high, double origin, double pixel, int n) {
  return {std::max(0, static_cast<int>(std::ceil((low - origin) / pixel - 0.5))),
          std::min(n - 1, static_cast<int>(std::floor((high - origin) / pixel - 0.5)))};
}

/// Calls visit(i, j) for the pixels whose centre lies inside the disc.
template <class Visit>
void for_pixels(const Disc& disc, const Window& window, double pixel, int nx, int ny, Visit visit) {
  const Span rows = span(disc.y - disc.radius, disc.y + disc.radius, window.bottom, pixel, ny);
  for (int j = rows.first; j <= rows.last; ++j) {
    const double dy = window.bottom + (j + 0.5) * pixel - disc.y;
    const double half = std::sqrt(std::max(0.0, disc.radius * disc.radius - dy * dy));
    const Span columns = span(disc.x - half, disc.x + half, window.left, pixel, nx);
    for (int i = columns.first; i <= columns.last; ++i) visit(i, j);
  }
}

int pixels_along(double length, double pixel) {
  return std::max(1, static_cast<int>(std::ceil(length / pixel - 1e-9)));
}

}  // namespace

std::vector<Disc> seen_from(const View& view, const std::vector<Vec3>& centres,
                            const std::vector<double>& radii) {
  std::vector<Disc> discs;
  discs.reserve(centres.size());
  for (std::size_t i = 0; i < centres.size(); ++i)
    discs.push_back(
        {dot(view.right, centres[i]), dot(view.up, centres[i]), dot(view.towards, centres[i]), radii[i]});
  return discs;
}

Window window_of(const std::vector<Disc>& discs, double margin) {
  if (discs.empty()) return {};
  const double far = std::numeric_limits<double>::max();
  Window w{far, far, -far, -far};
  for (const Disc& d : discs) {
    w.left = std::min(w.left, d.x - d.radius);
    w.right = std::max(w.right, d.x + d.radius);
    w.bottom = std::min(w.bottom, d.y - d.radius);
    w.top = std::max(w.top, d.y + d.radius);
  }
  return {w.left - margin, w.bottom - margin, w.right + margin, w.top + margin};
}

Silhouette::Silhouette(const Window& picture, double pixel_size) : window(picture), pixel(pixel_size) {
  const double width = window.right - window.left, height = window.top - window.bottom;
  if (!(width > 0) || !(height > 0) || !(pixel > 0))
    throw RunError("A picture of the seeds has no size: there are no seeds in it.");
  if (width / pixel * (height / pixel) > 1e8)
    throw RunError("A picture of the seeds would have more than 1e8 pixels of " + std::to_string(pixel) +
                   " m. Choose larger pixels.");
  nx = pixels_along(width, pixel);
  ny = pixels_along(height, pixel);
  pixels.assign(static_cast<std::size_t>(nx) * ny, 0);
}

void Silhouette::add(const Disc& disc) {
  for_pixels(disc, window, pixel, nx, ny,
             [this](int i, int j) { pixels[static_cast<std::size_t>(j) * nx + i] = 1; });
}

double Silhouette::filled_share() const {
  return static_cast<double>(std::count(pixels.begin(), pixels.end(), 1)) /
         static_cast<double>(pixels.size());
}

Silhouette::Boundary Silhouette::upper_boundary() const {
  Boundary boundary;
  for (int i = 0; i < nx; ++i)
    for (int j = ny - 1; j >= 0; --j)
      if (filled(i, j)) {
        boundary.x.push_back(x_of(i));
        boundary.y.push_back(window.bottom + (j + 1) * pixel);
        break;
      }
  return boundary;
}

std::vector<double> visible_shares(const std::vector<Disc>& discs, double pixel) {
  std::vector<double> share(discs.size(), 0);
  if (discs.empty()) return share;
  const Window window = window_of(discs, pixel);
  const int nx = pixels_along(window.right - window.left, pixel),
            ny = pixels_along(window.top - window.bottom, pixel);
  std::vector<int> owner(static_cast<std::size_t>(nx) * ny, -1);
  std::vector<long> all(discs.size(), 0), seen(discs.size(), 0);
  for (std::size_t d = 0; d < discs.size(); ++d)
    for_pixels(discs[d], window, pixel, nx, ny, [&](int i, int j) {
      ++all[d];
      int& front = owner[static_cast<std::size_t>(j) * nx + i];
      // The surface of a sphere, not its centre, decides what hides what.
      const auto surface = [&](const Disc& of) {
        const double dx = window.left + (i + 0.5) * pixel - of.x,
                     dy = window.bottom + (j + 0.5) * pixel - of.y;
        return of.depth + std::sqrt(std::max(0.0, of.radius * of.radius - dx * dx - dy * dy));
      };
      if (front < 0 || surface(discs[d]) > surface(discs[front])) front = static_cast<int>(d);
    });
  for (const int o : owner)
    if (o >= 0) ++seen[o];
  for (std::size_t d = 0; d < discs.size(); ++d)
    if (all[d] > 0) share[d] = static_cast<double>(seen[d]) / static_cast<double>(all[d]);
  return share;
}

}  // namespace seedflow
