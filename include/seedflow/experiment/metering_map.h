#pragma once

#include <string>
#include <vector>

#include "seedflow/experiment/metering.h"

namespace seedflow {

/// Section "Study" of the metering map: every combination of the lists is one run per repeat.
struct MeteringMapParameters {
  std::vector<double> vacuums{-2000, -3000, -4000};  ///< [Pa]
  std::vector<double> speeds{20 * 0.10471975511965977, 30 * 0.10471975511965977,
                             40 * 0.10471975511965977};  ///< [rad/s]
  std::vector<double> hole_diameters{2e-3};              ///< [m]
  double turns = 1;  ///< length of each run in turns of the disc; slower discs run longer
  int repeats = 1;

  void declare(Parameters& parameters);
};

/// All entries of the .prm of "metering" and "metering map"; a single run does not use the study.
struct MeteringInput {
  MeteringInput() = default;
  /// `options` name the file that lists the materials.
  explicit MeteringInput(const RunOptions& options);
  void declare(Parameters& parameters);

  std::string name = "metering";
  Metering experiment;
  MeteringMapParameters map;
};

}  // namespace seedflow
