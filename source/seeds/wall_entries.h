#pragma once

#include <string>
#include <vector>

#include "seedflow/seeds/walls.h"

namespace seedflow {

class Parameters;

/// Entries of a .prm that describe one wall's surface; internal to WallTable. What is declared depends on the
/// shape, the outline and the pattern of holes.
struct ShapeEntries {
  Vec3 point, normal{0, 0, 1}, along{1, 0, 0};
  double length = 0, width = 0, radius = 0, thickness = 0;
  Vec3 low, high;
  std::string side;
  bool base_cap = true, end_cap = true;
  std::string outline = "rectangle", holes = "none";
  double hole_diameter = 0, pitch_along = 0, pitch_across = 0, pitch_radius = 0, first_angle = 0;
  double chamfer_width = 0, chamfer_depth = 0;
  int n_along = 0, n_across = 0, n_ring = 0;
  std::vector<double> positions;
  std::string file;
  double file_unit = 1e-3;

  void declare(Parameters& parameters, const std::string& shape);
  /// `name` of the wall, for messages.
  Surface surface(const std::string& shape, const std::string& name) const;

 private:
  void declare_plate(Parameters& parameters);
  Plate plate() const;
};

std::vector<std::string> shape_names();
std::vector<std::string> outline_names();
std::vector<std::string> hole_pattern_names();
std::vector<std::string> law_names();

/// Entries of one law in time; what is declared depends on its kind.
struct LawEntries {
  std::string kind = "rest", expression;
  double speed = 0, duration = 0, amplitude = 0, frequency = 0, phase = 0, start = 0, stop = 1e9;

  /// `name` of the entry with the kind; names and units of the others.
  void declare(Parameters& parameters, const std::string& name, const std::string& speed_name,
               const std::string& amplitude_name, const std::string& unit, const std::string& speed_unit,
               const std::string& prefix);
  TimeLaw law() const;
};

}  // namespace seedflow
