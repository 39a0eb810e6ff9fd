#pragma once

#include <iosfwd>
#include <vector>

#include "seedflow/base/device_geometry.h"
#include "seedflow/coupling/suction_step.h"

namespace seedflow {

/// Places on the way of a hole, as angles [rad].
struct SeedingStations {
  double pool = 0;      ///< a passage begins
  double carried = 0;   ///< out of the pool, before the blade
  double cleaned = 0;   ///< behind the blade
  double unloaded = 0;  ///< just before the vacuum ends
};

/// One way of a hole from the pool to the unloading point; numbers of seeds at the stations, -1: not reached.
struct Passage {
  int hole = 0;
  double begun = 0;  ///< [s]
  int carried = -1, cleaned = -1, unloaded = -1;
  std::vector<long> seeds = {}, kept = {};  ///< labels of those it carried before and behind the blade
};

/// What one seed went through, one entry per record: the curves of Fig. 24.
struct SeedSample {
  float time = 0;                             ///< [s]
  float x = 0, y = 0, z = 0;                  ///< centre [m]
  float speed = 0;                            ///< [m/s]
  float drag = 0, pressure = 0, contact = 0;  ///< sizes of the forces [N]
  std::int32_t hole = -1;                     ///< that carries it, or -1
};

/// Watches holes and seeds during a run. A hole carries a seed whose centre is within `capture` of the
/// hole's mouth and that moves with the disc (velocities differ by less than half the holes' speed).
class SeedingRecord {
 public:
  SeedingRecord(const DeviceGeometry& device, const SeedingStations& stations, double capture, double ground,
                const Vec3& gravity);

  /// After every interval. `turned` and `speed`: of the disc [rad], [rad/s]; `tilt`: displacement along its
  /// axis [m].
  void update(const Dem& dem, const std::vector<SeedLoad>& loads, double time, double turned, double speed);

  const std::vector<Passage>& passages() const { return passage; }
  /// Number of seeds each hole carries now.
  const std::vector<int>& carried_now() const { return now; }
  /// Hole that carries a seed now, or -1.
  const std::vector<int>& hole_of_seed() const { return carrier; }
  /// Times at which seeds fell below the ground line, in the order of falling [s], and their labels.
  const std::vector<double>& landing_times() const { return landed_at; }
  const std::vector<SeedSample>& track(int seed) const { return tracks[seed]; }
  int n_tracks() const { return static_cast<int>(tracks.size()); }

  void save(std::ostream& out) const;
  void load(std::istream& in);

 private:
  void find_carriers(const Dem& dem, double turned, double speed);
  std::vector<long> labels_at(const Dem& dem, int hole) const;  ///< of the seeds a hole carries now
  void pass_stations(const Dem& dem, double time, double turned);
  void sample(const Dem& dem, const std::vector<SeedLoad>& loads, double time);

  DeviceGeometry device;
  SeedingStations station;
  double capture, ground;
  Vec3 gravity;
  double last_time = 0, last_turned = 0;
  std::vector<Passage> passage;
  std::vector<int> open;  ///< [hole] its passage, or -1
  std::vector<int> now, carrier;
  std::vector<Vec3> last_centre, last_velocity;  ///< [seed]
  std::vector<double> landed_at;
  std::vector<std::vector<SeedSample>> tracks;  ///< [seed]
};

}  // namespace seedflow
