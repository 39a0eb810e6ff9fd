#include "seedflow/diagnose/selection.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <set>

namespace seedflow {

namespace {

constexpr std::size_t beam = 5;  ///< sets that are weighed with their own runs, per size

void sort_by_score(std::vector<Weighed>& all) {
  std::stable_sort(all.begin(), all.end(),
                   [](const Weighed& a, const Weighed& b) { return a.score > b.score; });
}

/// Sets with one more candidate than the best ones, screened by added-up changes.
std::vector<std::vector<int>> grown(Weighing& weighing, const std::vector<Weighed>& parents,
                                    std::size_t n_parents, const std::vector<int>& acting,
                                    const std::vector<bool>& use) {
  std::set<std::vector<int>> seen;
  std::vector<Weighed> screened;
  for (std::size_t p = 0; p < std::min(n_parents, parents.size()); ++p) {
    NoiseChains chains = {{stated_noise}};
    if (!parents[p].noise.as_stated()) chains.push_back({parents[p].noise});
    for (const int k : acting) {
      std::vector<int> set = parents[p].what.set;
      if (std::find(set.begin(), set.end(), k) != set.end()) continue;
      set.push_back(k);
      std::sort(set.begin(), set.end());
      if (seen.insert(set).second) screened.push_back(weighing.weigh({set}, use, false, chains));
    }
  }
  sort_by_score(screened);
  std::vector<std::vector<int>> best;
  for (std::size_t i = 0; i < std::min(beam, screened.size()); ++i)
    if (screened[i].possible) best.push_back(screened[i].what.set);
  return best;
}

}  // namespace

Split split_series(const ObservableModel& model, const DataNoise& noise, const std::vector<bool>& usable) {
  Split split;
  for (const auto& series : noise.series()) {
    const int c = model.points()[series[0]].condition;
    const bool held = model.conditions()[c].held_out;
    split.training.push_back(usable[c] && !held);
    split.held_out.push_back(usable[c] && held);
    split.all.push_back(usable[c]);
    split.has_held_out = split.has_held_out || (usable[c] && held);
  }
  return split;
}

void predict_held_out(Weighing& weighing, const DataNoise& noise, const std::vector<bool>& to, Tried& tried) {
  (void)weighing;
  const LinearFit predicted = fit(noise, tried.trained.noise, tried.trained.linear, to, &tried.trained.fit);
  tried.predictive = predicted.log_evidence;
  tried.chi2_held_out = predicted.chi2;
  tried.points_held_out = predicted.points;
}

std::vector<Tried> select(Weighing& weighing, const DataNoise& noise, const Split& split,
                          const std::vector<int>& acting, int largest) {
  const NoiseChains& chains = noise_chains();
  std::vector<Weighed> all, level;
  all.push_back(weighing.weigh({}, split.training, true, chains));
  for (const int k : weighing.inputs_that_may_be_off())
    all.push_back(weighing.weigh({{}, k}, split.training, true, chains));
  for (const int k : acting) level.push_back(weighing.weigh({{k}}, split.training, true, chains));
  sort_by_score(level);
  all.insert(all.end(), level.begin(), level.end());
  for (int size = 2; size <= largest; ++size) {
    std::vector<Weighed> next;
    const auto sets = grown(weighing, level, size == 2 ? 5 : 3, acting, split.training);
    weighing.prepare(sets);
    for (const std::vector<int>& set : sets)
      next.push_back(weighing.weigh({set}, split.training, true, chains));
    sort_by_score(next);
    all.insert(all.end(), next.begin(), next.end());
    // A larger set is only worth a search if this size has gained on the smaller one.
    if (next.empty() || level.empty() || next[0].score < level[0].score) break;
    level = next;
  }
  std::vector<Tried> tried;
  for (const Weighed& weighed : all) {
    Tried one{weighed};
    if (weighed.possible && split.has_held_out) predict_held_out(weighing, noise, split.held_out, one);
    tried.push_back(one);
  }
  std::stable_sort(tried.begin(), tried.end(), [](const Tried& a, const Tried& b) {
    return a.trained.possible != b.trained.possible ? a.trained.possible : a.total() > b.total();
  });
  return tried;
}

std::vector<Eigen::Index> raise_outliers(DataNoise& noise, const LinearModel& nothing_missing,
                                         const std::vector<bool>& use) {
  // A smooth discrepancy stands for whatever is missing, so that only lone points stick out.
  std::vector<NoiseVariant> smooth;
  for (const double size : {1e-3, 2.5, 6.0, 15.0, 40.0, 100.0}) smooth.push_back({1, size, 0.3});
  std::vector<Eigen::Index> found;
  std::size_t n = 0;
  for (const auto& series : noise.series()) n += series.size();
  for (std::size_t pass = 0; pass < std::max<std::size_t>(1, n / 10); ++pass) {
    const NoiseVariant* best = nullptr;
    double highest = -1e300;
    for (const NoiseVariant& variant : smooth) {
      const double e = WhitenedModel(noise, variant, nothing_missing, use).brief().log_evidence;
      if (e > highest) highest = e, best = &variant;
    }
    double largest = 0, size = 0;
    Eigen::Index worst = -1;
    std::vector<double> every;
    for (std::size_t s = 0; s < noise.series().size(); ++s) {
      const auto& at = noise.series()[s];
      if (!use[s] || at.size() < 5) continue;
      const Eigen::MatrixXd inverse =
          noise.block(s, *best, nothing_missing.tolerance)
              .llt()
              .solve(Eigen::MatrixXd::Identity(static_cast<Eigen::Index>(at.size()), at.size()));
      Eigen::VectorXd r(static_cast<Eigen::Index>(at.size()));
      for (std::size_t i = 0; i < at.size(); ++i)
        r[static_cast<Eigen::Index>(i)] = nothing_missing.residual[at[i]];
      const Eigen::VectorXd pulled = inverse * r;
      for (std::size_t i = 0; i < at.size(); ++i) {
        const auto j = static_cast<Eigen::Index>(i);
        const double t = std::abs(pulled[j]) / std::sqrt(inverse(j, j));
        every.push_back(t);
        if (t > largest) {
          largest = t, worst = at[i];
          size = std::abs(pulled[j] / inverse(j, j)) / noise.sigma(worst);
        }
      }
    }
    if (worst < 0) break;
    // Scatter that is larger than stated everywhere makes no outliers.
    std::nth_element(every.begin(), every.begin() + every.size() / 2, every.end());
    const double scale = std::max(1.0, every[every.size() / 2] / 0.6745);
    if (largest < 4.5 * scale || size < 3) break;
    noise.inflate(worst, std::max(size, 3.0));
    found.push_back(worst);
  }
  return found;
}

}  // namespace seedflow
