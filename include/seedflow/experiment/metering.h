#pragma once

#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "seedflow/base/device_geometry.h"
#include "seedflow/coupling/resolved_suction.h"
#include "seedflow/coupling/suction_step.h"
#include "seedflow/experiment/granular_run.h"
#include "seedflow/experiment/seed_picture.h"
#include "seedflow/experiment/seeding_quality.h"
#include "seedflow/experiment/seeding_record.h"
#include "seedflow/output/vtu.h"
#include "seedflow/seeds/device_surfaces.h"

namespace seedflow {

/// What stands in front of the disc besides the housing: chamber, blade, guide tube. The air does not see
/// these.
struct MeteringParts {
  double chamber_from = -135 * 3.14159265358979323846 / 180;  ///< the chamber's outer wall begins [rad]
  double chamber_to = 75 * 3.14159265358979323846 / 180;      ///< and ends [rad]

  double blade_angle = 25 * 3.14159265358979323846 / 180;   ///< of its first tooth [rad]
  double blade_length = 20 * 3.14159265358979323846 / 180;  ///< along the pitch circle [rad]
  int teeth = 8;
  double tooth_depth = 1.5e-3;                     ///< [m]
  double passage_in = 5e-3, passage_out = 2.5e-3;  ///< from the pitch circle to the teeth's tips [m]
  double blade_clearance = 0.5e-3;                 ///< between disc and blade [m]
  double blade_height = 5e-3;                      ///< along the axis [m]
  std::string blade_sides = "outer";               ///< both | outer | inner | none

  double tube_position = -91e-3, tube_width = 22e-3;  ///< x of its middle [m]
  double tube_top = -45e-3, tube_end = -160e-3;       ///< heights y [m]
  double floor = -240e-3;                             ///< height of the catch bin's floor [m]
};

/// Experiment "metering" (Xu et al. 2024, section 5): an air-suction seed-metering device. The disc turns
/// from the start at full speed and full vacuum; seeds rest at the bottom of the seed chamber, holes that
/// pass through draw seeds, a blade with teeth takes surplus ones off, where the vacuum ends the seeds fall
/// into the guide tube.
struct Metering {
  GranularParameters granular;
  DeviceGeometry device;
  DeviceSurfaces surfaces;  ///< instead of disc, housing (chamber wall, divider, hub, tube) and blade
  MeteringParts parts;
  SuctionParameters suction;
  CouplingParameters coupling;
  EffectSet effects;
  std::string air_model = "hole sinks";                 ///< hole sinks | resolved
  ResolvedSuctionParameters resolved;                   ///< of the air "resolved"
  double speed = 30 * 2 * 3.14159265358979323846 / 60;  ///< of the disc [rad/s]
  double forward_speed = 3;                             ///< of the machine [m/s]
  std::string disc_material = "photosensitive resin", housing_material = "transparent plexiglass";
  std::vector<double> picture_at{0.3, 0.76, 1.5};  ///< [s]

  Metering();
  void declare(Parameters& parameters);
  void check(const Parameters& parameters);

  SeedingStations stations() const;
  /// Distance of seeds on the ground if every hole lays one [m].
  double target_spacing() const { return forward_speed * device.pitch_angle() / speed; }
  /// Highest number of holes that pass per second [1/s].
  double holes_per_second() const { return speed / device.pitch_angle(); }

  std::vector<Wall> walls() const;
  static constexpr int disc_wall = 0, filling_wall = 1;  ///< in walls()
  FillingRoom room() const;
  /// Corners of the blade on one side of the pitch circle: along the teeth, then back. `side`: +1 outer, -1
  /// inner [m].
  std::vector<std::array<double, 2>> blade_teeth(int side) const;

  /// What the scene carries along.
  struct Gathered {
    Gathered(const Metering& metering, EffectSet& effects);
    /// One of the two is there, by Metering::air_model.
    std::optional<SuctionStep> sinks;
    std::optional<ResolvedSuction> resolved;
    Vec3 advance(Dem& dem, double duration);
    const std::vector<SeedLoad>& seed_loads() const;
    const SuctionBalance& chamber() const;
    double air_drawn() const;  ///< since the start [m3]
    double work() const;       ///< of the vacuum on it [J]
    void save_air(std::ostream& out) const;
    void load_air(std::istream& in);

    SeedingRecord record;
    std::optional<PvdSeries> air_files;
    long next_field = 0;
    double start = 0, last_time = -1;
    double suction_sum = 0, flow_sum = 0;
    long intervals = 0;
  };
  /// `gathered` must outlive the scene. Pictures are written into the folder unless it is empty; fields of
  /// the computed air, by all ranks, into `output` unless it is empty.
  GranularScene scene(Gathered& gathered, const std::filesystem::path& folder,
                      const std::filesystem::path& output = {}) const;
  SeedPicture picture(const Dem& dem, double turned, const std::string& title) const;
  double turned_at(double time) const { return speed * time; }

  /// The walls' parts, from parameters.
  void add_chamber(std::vector<Wall>& walls, int material) const;
  void add_blade(std::vector<Wall>& walls, int material) const;

 private:
  Surface disc_surface() const;
  void check_resolved(const Parameters& parameters) const;
  void write_air(Gathered& gathered, double time, const std::filesystem::path& output) const;
};

/// The device at rest on a test bench, in closed form: air flow, vacuum and holding force over the number of
/// holes that seeds cover.
struct SuctionBench {
  double flow = 0;     ///< through the fan [m3/s]
  double vacuum = 0;   ///< of the chamber below ambient [Pa]
  double holding = 0;  ///< force on a seated seed [N]
};
/// \param covered number of holes with a seated seed, of those that face the vacuum
SuctionBench suction_bench(const Metering& metering, double covered);

int run_metering(const RunOptions& options);
/// The parametric device as files for a device of one's own: device.msh, disc.stl, housing.stl, blade.stl in
/// mm; parametric.prm with all entries, own_device.prm, which includes it and names the files.
int write_metering_geometry(const RunOptions& options);
void describe_metering(std::ostream& out, const std::string& section);
Observer metering_observer();
int run_metering_map(const RunOptions& options);

}  // namespace seedflow
