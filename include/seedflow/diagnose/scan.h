#pragma once

#include <cstdint>
#include <vector>

#include "seedflow/diagnose/gaussian_fit.h"

namespace seedflow {

/// A group of points that have something in common.
struct Bin {
  std::string axis, name;
  double low = 0, high = 0;
  std::vector<Eigen::Index> points;
};

/// Bins over conditions, quantities, thirds of every coordinate and thirds of every regime of the experiment.
/// Only points of the series for which `use` holds.
std::vector<Bin> make_bins(ObservableModel& model, const DataNoise& noise, const std::vector<bool>& use);

/// Ranks bins by how much the standardised residuals z exceed the scatter expected of them,
/// (sum z^2 - n)/sqrt(2 n), with p-values by permuting the points: the share of permutations in which the
/// largest statistic over all bins (each divided by its spread) is larger.
std::vector<Place> scan(const std::vector<Bin>& bins, const Eigen::VectorXd& z, int permutations = 200,
                        std::uint64_t seed = 1);

}  // namespace seedflow
