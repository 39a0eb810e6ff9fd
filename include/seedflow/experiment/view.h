#pragma once

#include <vector>

#include "seedflow/base/vector.h"

namespace seedflow {

/// A camera far away: what stands along `right` and `up` in the picture; it looks against `towards`, which
/// points to the eye. The three are orthonormal.
struct View {
  Vec3 right{1, 0, 0}, up{0, 0, 1}, towards{0, -1, 0};
};

/// A sphere as the camera sees it: place in the picture, distance towards the eye, radius [m].
struct Disc {
  double x = 0, y = 0, depth = 0, radius = 0;
};
std::vector<Disc> seen_from(const View& view, const std::vector<Vec3>& centres,
                            const std::vector<double>& radii);

/// A part of the picture plane [m].
struct Window {
  double left = 0, bottom = 0, right = 0, top = 0;
};
/// Smallest window that holds all discs, widened by `margin` [m].
Window window_of(const std::vector<Disc>& discs, double margin);

/// A black and white picture made of square pixels, as the paper's binarised photographs.
class Silhouette {
 public:
  /// \param pixel edge of a pixel [m]. Errors: RunError for an empty window or more than 1e8 pixels.
  Silhouette(const Window& window, double pixel);

  /// Fills the pixels whose centre lies inside the disc.
  void add(const Disc& disc);

  int width() const { return nx; }
  int height() const { return ny; }
  double pixel_size() const { return pixel; }
  bool filled(int i, int j) const { return pixels[static_cast<std::size_t>(j) * nx + i]; }
  double x_of(int i) const { return window.left + (i + 0.5) * pixel; }
  /// Share of the window that is filled.
  double filled_share() const;

  /// The boundary seen from above: in every column that has one, the upper edge of the highest filled pixel.
  struct Boundary {
    std::vector<double> x, y;  ///< [m]
  };
  Boundary upper_boundary() const;

 private:
  Window window;
  double pixel;
  int nx, ny;
  std::vector<char> pixels;
};

/// Share of each disc that no nearer disc hides, by pixels of the given size [m]. A disc smaller than a pixel
/// may get 0.
std::vector<double> visible_shares(const std::vector<Disc>& discs, double pixel);

}  // namespace seedflow
