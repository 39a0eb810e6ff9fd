#include "seedflow/seeds/contact_census.h"

#include <algorithm>
#include <set>
#include <tuple>

namespace seedflow {

ContactCensus contact_census(const Dem& dem) {
  ContactCensus census;
  const ContactNetwork network = dem.contact_network();
  census.n_contacts = static_cast<int>(network.size());
  if (network.empty()) return census;

  std::vector<Vec3> position;
  dem.positions(position);
  std::vector<long> labels(dem.n_seeds());
  for (int s = 0; s < dem.n_seeds(); ++s) labels[s] = dem.seed_label(s);
  const auto sphere_of = [&](long label, int sphere) {
    const auto seed = std::lower_bound(labels.begin(), labels.end(), label) - labels.begin();
    return dem.first_sphere(static_cast<int>(seed)) + sphere;
  };
  std::vector<Placement> places;
  for (const Wall& wall : dem.walls()) places.push_back(placement(wall, dem.time()));

  std::set<std::tuple<long, long, int>> touching;
  std::vector<WallPoint> points;
  double sum = 0;
  int between_seeds = 0, pairs = 0, ends = 0;
  for (const NetworkContact& c : network) {
    const int a = sphere_of(c.label_a, c.sphere_a);
    const double radius = dem.radii()[a];
    double overlap = 0;
    const bool is_new = touching.insert({c.label_a, c.label_b, c.wall}).second;
    if (c.label_b >= 0) {
      const int b = sphere_of(c.label_b, c.sphere_b);
      const double other = dem.radii()[b];
      overlap = (radius + other - norm(position[a] - position[b])) / std::min(radius, other);
      ++between_seeds, pairs += is_new, ends += 2 * is_new;
    } else {
      points.clear();
      contacts_near(dem.walls()[c.wall], places[c.wall], position[a], radius, points);
      for (const WallPoint& point : points)
        if (point.feature == c.feature) overlap = std::max(overlap, 1 - point.distance / radius);
      ends += is_new;
    }
    overlap = std::max(overlap, 0.0);
    sum += overlap;
    census.largest_overlap = std::max(census.largest_overlap, overlap);
  }
  census.mean_overlap = sum / census.n_contacts;
  census.neighbours_per_seed = static_cast<double>(ends) / dem.n_seeds();
  census.contacts_per_pair = pairs > 0 ? static_cast<double>(between_seeds) / pairs : 0;
  return census;
}

}  // namespace seedflow
