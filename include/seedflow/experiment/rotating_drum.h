#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

#include "seedflow/experiment/bed_contour.h"
#include "seedflow/experiment/granular_run.h"
#include "seedflow/experiment/lacey_index.h"
#include "seedflow/experiment/seed_picture.h"

namespace seedflow {

/// Mean velocity of the seeds across the bed: component along the free surface, downhill positive, against
/// the distance from the drum's axis along the surface's normal (negative below the axis).
struct VelocityProfile {
  double low = 0, bin = 1;  ///< lower edge of the first bin, width [m]
  std::vector<double> sum, count;

  void add(double y, double velocity);
  /// Middle of the bins that saw at least `least` seeds [m], and the mean there [m/s].
  void mean(std::vector<double>& y, std::vector<double>& velocity, double least = 20) const;
};

/// Experiment "rotating drum" (Xu et al. 2024, section 3.2.3): two colours of seeds rest on both sides of a
/// diaphragm; it is taken away and the drum turns. The picture looks through the front end: x to the right, z
/// up; the axis of the drum is y. The drum turns counter-clockwise in the picture, so the surface rises to
/// the right.
struct RotatingDrum {
  GranularParameters granular;
  double radius = 50e-3, length = 45e-3;                ///< inside [m]
  double speed = 40 * 2 * 3.14159265358979323846 / 60;  ///< [rad/s]
  double revolutions = 5;
  bool diaphragm = true;  ///< two colours, one on each side; else one colour
  std::string barrel_material = "photosensitive resin", end_material = "transparent plexiglass";
  std::vector<double> cells{5e-3, 10e-3, 15e-3};  ///< edges of the Lacey cells [m]
  std::string lacey_count = "seeds";              ///< what is counted in them: seeds | sub-spheres
  std::vector<double> picture_at{1, 1.5, 2};      ///< [revolutions]
  double plateau_from = 4;                        ///< [revolutions]
  double profile_from = 1;                        ///< [revolutions]
  std::string measurements;                       ///< file, quantity "velocity", or ""
  BedContourSettings contour;

  void declare(Parameters& parameters);
  void check(const Parameters& parameters);

  /// What is gathered on the way.
  struct Gathered {
    VelocityProfile profile;
    double last_revolutions = 0;
  };
  /// `gathered` must outlive the scene. Pictures are written into the folder unless it is empty.
  GranularScene scene(Gathered& gathered, const std::filesystem::path& folder) const;

  double revolutions_at(double time) const { return time * speed / (2 * 3.14159265358979323846); }
  BedContour measure_contour(const Dem& dem) const;
  /// Of the line from the axis to the seeds' centre of mass, against the vertical [rad].
  double centre_of_mass_angle(const Dem& dem) const;
  /// Of the seeds seen through the front end (`view`), or of all. Counted by sub-spheres: of all, in columns
  /// through the whole drum (`view`) or in cubes.
  LaceyIndex measure_mixing(const Dem& dem, double cell, bool view) const;
  SeedPicture picture(const Dem& dem, const std::string& title, const BedContour* contour = nullptr) const;
};

namespace drum_reference {
inline constexpr double measured_plateau = 85.57;  ///< Lacey index at 40 rpm [%]
/// Simulated in the paper: BS 0.125, 0.1, 0.075 [%].
inline constexpr double simulated_plateau[3] = {91.39, 90.55, 89.92};
}  // namespace drum_reference

int run_rotating_drum(const RunOptions& options);
void describe_rotating_drum(std::ostream& out, const std::string& section);
/// Quantities "surface angle" and "centre of mass angle", both means from Drum/Plateau from on.
Observer rotating_drum_observer();
int run_rotating_drum_study(const RunOptions& options);

}  // namespace seedflow
