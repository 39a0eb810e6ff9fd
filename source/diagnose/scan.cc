#include "seedflow/diagnose/scan.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

namespace seedflow {

namespace {

std::string range_text(double low, double high) {
  char text[64];
  std::snprintf(text, sizeof text, "%.3g to %.3g", low, high);
  return text;
}

/// Thirds of equal count by value.
void add_thirds(const std::string& axis, std::vector<std::pair<double, Eigen::Index>> values,
                std::vector<Bin>& bins) {
  if (values.size() < 6) return;
  std::sort(values.begin(), values.end());
  if (!(values.back().first > values.front().first * (1 + 1e-6) + 1e-12)) return;
  for (int third = 0; third < 3; ++third) {
    const std::size_t begin = third * values.size() / 3, end = (third + 1) * values.size() / 3;
    Bin bin;
    bin.axis = axis;
    bin.low = values[begin].first;
    bin.high = values[end - 1].first;
    bin.name = range_text(bin.low, bin.high);
    for (std::size_t i = begin; i < end; ++i) bin.points.push_back(values[i].second);
    bins.push_back(bin);
  }
}

}  // namespace

std::vector<Bin> make_bins(ObservableModel& model, const DataNoise& noise, const std::vector<bool>& use) {
  std::map<int, Bin> condition;
  std::map<std::string, Bin> quantity;
  std::map<std::string, std::vector<std::pair<double, Eigen::Index>>> coordinate;
  std::vector<char> used(model.points().size(), 0);
  for (std::size_t s = 0; s < noise.series().size(); ++s) {
    if (!use[s]) continue;
    for (std::size_t i = 0; i < noise.series()[s].size(); ++i) {
      const Eigen::Index p = noise.series()[s][i];
      used[p] = 1;
      const DataPoint& point = model.points()[p];
      condition[point.condition].points.push_back(p);
      quantity[point.quantity].points.push_back(p);
      if (std::isfinite(point.coordinate))
        coordinate[model.coordinate_name(point.quantity)].emplace_back(point.coordinate, p);
    }
  }
  std::vector<Bin> bins;
  for (auto& [c, bin] : condition) {
    bin.axis = "condition", bin.name = model.conditions()[c].name;
    if (condition.size() > 1) bins.push_back(bin);
  }
  for (auto& [name, bin] : quantity) {
    bin.axis = "quantity", bin.name = name;
    if (quantity.size() > 1) bins.push_back(bin);
  }
  for (const auto& [name, values] : coordinate) add_thirds(name, values, bins);
  for (const std::string& name : model.regimes()) {
    const Eigen::VectorXd value = model.regime(name);
    std::vector<std::pair<double, Eigen::Index>> values;
    for (Eigen::Index i = 0; i < value.size(); ++i)
      if (used[i] && std::isfinite(value[i])) values.emplace_back(value[i], i);
    add_thirds(name, values, bins);
  }
  return bins;
}

std::vector<Place> scan(const std::vector<Bin>& bins, const Eigen::VectorXd& z, int permutations,
                        std::uint64_t seed) {
  std::vector<Eigen::Index> all;
  for (const Bin& bin : bins)
    for (const Eigen::Index i : bin.points) all.push_back(i);
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  std::vector<double> square(z.size(), 0), mixed(z.size(), 0);
  double mean = 0, variance = 0;
  for (const Eigen::Index i : all) square[i] = z[i] * z[i], mean += square[i];
  mean /= std::max<std::size_t>(all.size(), 1);
  for (const Eigen::Index i : all) variance += std::pow(square[i] - mean, 2);
  variance /= std::max<std::size_t>(all.size(), 1);
  // Under permutation a bin's sum has mean n m and variance n v (N - n)/(N - 1).
  const auto contrast = [&](const Bin& bin, const std::vector<double>& values) {
    double sum = 0;
    for (const Eigen::Index i : bin.points) sum += values[i];
    const double n = static_cast<double>(bin.points.size()), total = static_cast<double>(all.size());
    const double spread = std::sqrt(n * variance * std::max(total - n, 1e-9) / std::max(total - 1, 1.0));
    return spread > 0 ? (sum - n * mean) / spread : 0;
  };
  std::vector<double> largest;
  std::mt19937_64 random(seed);
  std::vector<Eigen::Index> order = all;
  for (int p = 0; p < permutations; ++p) {
    std::shuffle(order.begin(), order.end(), random);
    for (std::size_t i = 0; i < all.size(); ++i) mixed[all[i]] = square[order[i]];
    double top = -1e300;
    for (const Bin& bin : bins) top = std::max(top, contrast(bin, mixed));
    largest.push_back(top);
  }
  std::vector<Place> places;
  for (const Bin& bin : bins) {
    Place place;
    place.axis = bin.axis, place.bin = bin.name, place.low = bin.low, place.high = bin.high;
    const double c = contrast(bin, square);
    double sum = 0;
    for (const Eigen::Index i : bin.points) sum += square[i];
    const double n = static_cast<double>(bin.points.size());
    place.statistic = (sum - n) / std::sqrt(2 * n);
    const auto above = std::count_if(largest.begin(), largest.end(), [&](double t) { return t >= c; });
    place.p_value = (1.0 + static_cast<double>(above)) / (1.0 + permutations);
    places.push_back(place);
  }
  std::stable_sort(places.begin(), places.end(),
                   [](const Place& a, const Place& b) { return a.statistic > b.statistic; });
  return places;
}

}  // namespace seedflow
