#include "seedflow/experiment/seeding_record.h"

#include <cmath>

#include "seedflow/base/binary.h"

namespace seedflow {

namespace {

/// Whether a turning angle came past `mark` (modulo whole turns) on its way from a to b.
bool passed(double a, double b, double mark) {
  const double turn = 2 * M_PI;
  return std::floor((b - mark) / turn) > std::floor((a - mark) / turn);
}

}  // namespace

SeedingRecord::SeedingRecord(const DeviceGeometry& geometry, const SeedingStations& stations,
                             double capture_distance, double ground_line, const Vec3& g)
    : device(geometry),
      station(stations),
      capture(capture_distance),
      ground(ground_line),
      gravity(g),
      open(geometry.n_holes(), -1) {}

void SeedingRecord::find_carriers(const Dem& dem, double turned, double speed) {
  now.assign(device.n_holes(), 0);
  carrier.assign(dem.n_seeds(), -1);
  std::vector<Vec3> mouth(device.n_holes());
  for (int k = 0; k < device.n_holes(); ++k) mouth[k] = device.hole_centre(k, turned);
  for (int s = 0; s < dem.n_seeds(); ++s) {
    const SeedState seed = dem.seed_state(s);
    const Vec3 with_disc = cross(Vec3{0, 0, speed}, seed.centre);
    if (norm(seed.velocity - with_disc) > 0.5 * speed * device.pitch_radius) continue;
    double least = capture * capture;
    for (int k = 0; k < device.n_holes(); ++k) {
      const double square = norm_square(seed.centre - mouth[k]);
      if (square < least && device.exposure(device.hole_angle(k, turned)) > 0) least = square, carrier[s] = k;
    }
    if (carrier[s] >= 0) ++now[carrier[s]];
  }
}

std::vector<long> SeedingRecord::labels_at(const Dem& dem, int hole) const {
  std::vector<long> labels;
  for (int s = 0; s < dem.n_seeds(); ++s)
    if (carrier[s] == hole) labels.push_back(dem.seed_label(s));
  return labels;
}

void SeedingRecord::pass_stations(const Dem& dem, double time, double turned) {
  for (int k = 0; k < device.n_holes(); ++k) {
    const double before = device.hole_angle(k, last_turned), after = device.hole_angle(k, turned);
    if (open[k] >= 0) {
      Passage& p = passage[open[k]];
      if (passed(before, after, station.carried)) {
        p.carried = now[k];
        p.seeds = labels_at(dem, k);
      }
      if (passed(before, after, station.cleaned)) {
        p.cleaned = now[k];
        p.kept = labels_at(dem, k);
      }
      if (passed(before, after, station.unloaded)) p.unloaded = now[k], open[k] = -1;
    }
    if (passed(before, after, station.pool)) {
      open[k] = static_cast<int>(passage.size());
      passage.push_back({k, time});
    }
  }
}

void SeedingRecord::sample(const Dem& dem, const std::vector<SeedLoad>& loads, double time) {
  const double dt = time - last_time;
  tracks.resize(dem.n_seeds());
  for (int s = 0; s < dem.n_seeds(); ++s) {
    const SeedState seed = dem.seed_state(s);
    const SeedLoad load = loads.empty() ? SeedLoad() : loads[s];
    Vec3 contact;  // what accelerates the seed beside gravity and air
    if (!last_velocity.empty() && dt > 0)
      contact = dem.seed_template(s).mass * ((seed.velocity - last_velocity[s]) / dt - gravity) -
                load.pressure - load.drag;
    const auto f = [](double v) { return static_cast<float>(v); };
    tracks[s].push_back({f(time), f(seed.centre.x), f(seed.centre.y), f(seed.centre.z),
                         f(norm(seed.velocity)), f(norm(load.drag)), f(norm(load.pressure)), f(norm(contact)),
                         carrier[s]});
  }
}

void SeedingRecord::update(const Dem& dem, const std::vector<SeedLoad>& loads, double time, double turned,
                           double speed) {
  find_carriers(dem, turned, speed);
  if (!last_centre.empty()) {
    pass_stations(dem, time, turned);
    for (int s = 0; s < dem.n_seeds(); ++s) {
      const double above = last_centre[s].y - ground, below = dem.seed_state(s).centre.y - ground;
      if (above > 0 && below <= 0)
        landed_at.push_back(last_time + (time - last_time) * above / (above - below));
    }
  }
  sample(dem, loads, time);
  last_centre.resize(dem.n_seeds());
  last_velocity.resize(dem.n_seeds());
  for (int s = 0; s < dem.n_seeds(); ++s) {
    const SeedState seed = dem.seed_state(s);
    last_centre[s] = seed.centre, last_velocity[s] = seed.velocity;
  }
  last_time = time, last_turned = turned;
}

void SeedingRecord::save(std::ostream& out) const {
  write_binary(out, last_time);
  write_binary(out, last_turned);
  write_binary(out, static_cast<std::uint64_t>(passage.size()));
  for (const Passage& p : passage) {
    for (const int n : {p.hole, p.carried, p.cleaned, p.unloaded}) write_binary(out, n);
    write_binary(out, p.begun);
    write_binary(out, p.seeds);
    write_binary(out, p.kept);
  }
  write_binary(out, open);
  write_binary(out, now);
  write_binary(out, carrier);
  write_binary(out, last_centre);
  write_binary(out, last_velocity);
  write_binary(out, landed_at);
  write_binary(out, static_cast<std::uint64_t>(tracks.size()));
  for (const auto& track : tracks) write_binary(out, track);
}

void SeedingRecord::load(std::istream& in) {
  read_binary(in, last_time);
  read_binary(in, last_turned);
  std::uint64_t n = 0;
  read_binary(in, n);
  passage.resize(n);
  for (Passage& p : passage) {
    for (int* value : {&p.hole, &p.carried, &p.cleaned, &p.unloaded}) read_binary(in, *value);
    read_binary(in, p.begun);
    read_binary(in, p.seeds);
    read_binary(in, p.kept);
  }
  read_binary(in, open);
  read_binary(in, now);
  read_binary(in, carrier);
  read_binary(in, last_centre);
  read_binary(in, last_velocity);
  read_binary(in, landed_at);
  read_binary(in, n);
  tracks.resize(n);
  for (auto& track : tracks) read_binary(in, track);
}

}  // namespace seedflow
