#pragma once

#include <string>
#include <vector>

#include "seedflow/experiment/view.h"

namespace seedflow {

/// A line drawn over the seeds, for walls and fitted curves; points in the picture plane [m].
struct PictureLine {
  std::vector<double> x, y;
  std::string colour = "#333";
  double width = 1.5;  ///< [px]
  std::string dash = "";
};

/// Seeds from the side as a drawing: every visible seed is a shaded ball in the colour of its group, the far
/// ones first and a little darker, so that the near ones cover them.
struct SeedPicture {
  std::string title;                                  ///< stands above the picture
  Window window;                                      ///< [m]; seeds outside are not drawn
  double width = 520;                                 ///< of the drawing [px]
  std::vector<Disc> discs = {};                       ///< whole seeds
  std::vector<int> group = {};                        ///< colour, per disc
  std::vector<PictureLine> behind = {}, before = {};  ///< lines drawn before and after the seeds
  double scale_bar = 0.02;                            ///< [m]; 0: none

  std::string svg() const;
};

/// Several drawings side by side in one, `columns` in a row.
std::string picture_sheet(const std::vector<SeedPicture>& pictures, int columns);

}  // namespace seedflow
