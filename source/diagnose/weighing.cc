#include "seedflow/diagnose/weighing.h"

#include <algorithm>
#include <cmath>

namespace seedflow {

namespace {

constexpr double far_off = 10;    ///< chi2/n beyond which large discrepancies are likelier than small ones
constexpr double well_below = 6;  ///< the top of a chain of noise [nats]

}  // namespace

Weighing::Weighing(ObservableModel& model, Responses& responses, const DataNoise& noise, int acting)
    : model(model), responses(responses), noise(noise), acting(acting) {
  measured.resize(static_cast<Eigen::Index>(model.points().size()));
  for (std::size_t i = 0; i < model.points().size(); ++i)
    measured[static_cast<Eigen::Index>(i)] = model.points()[i].value;
}

std::vector<int> Weighing::inputs_that_may_be_off() const {
  std::vector<int> list;
  for (std::size_t m = 0; m < model.nuisances().size(); ++m) {
    const Nuisance& nuisance = model.nuisances()[m];
    // The drag level is no input: drag far off its law is a missing effect.
    if (nuisance.path.compare(0, 8, "Effects/") != 0 && !nuisance.each_condition)
      list.push_back(static_cast<int>(m));
  }
  return list;
}

double Weighing::price(const Hypothesis& what) const {
  double sum = static_cast<double>(what.set.size()) * std::log(std::max(acting, 1) / odds);
  if (what.nuisance >= 0) sum += std::log(static_cast<double>(model.nuisances().size()) / odds);
  return sum;
}

Eigen::Index Weighing::first_amplitude() {
  return static_cast<Eigen::Index>(model.uncertain_inputs().size()) + responses.numerics().cols();
}

LinearModel Weighing::linearise(const Hypothesis& what, const std::vector<double>& amplitude, bool joint) {
  return linearise(what, amplitude, responses.at(what.set, amplitude, joint),
                   joint ? responses.inputs(what.set, amplitude) : responses.inputs({}, {}));
}

LinearModel Weighing::linearise_about(const Setting& setting) {
  return linearise({}, {}, responses.at({}, {}, false), responses.inputs(setting));
}

LinearModel Weighing::linearise(const Hypothesis& what, const std::vector<double>& amplitude,
                                const Responses::Value& now, const Eigen::MatrixXd& inputs) {
  const Eigen::MatrixXd& numerics = responses.numerics();
  const Eigen::Index n = measured.size(), e = inputs.cols(), c = numerics.cols(),
                     k = static_cast<Eigen::Index>(what.set.size());
  LinearModel linear;
  linear.directions.setZero(n, e + c + k + (what.nuisance >= 0 ? 1 : 0));
  linear.directions.leftCols(e) = inputs;
  linear.directions.middleCols(e, c) = numerics;
  linear.directions.middleCols(e + c, k) = amplitude_deviation * now.slope;
  // x of an amplitude is (a - 1)/0.25: the residual is taken about a = 1.
  linear.residual = measured - now.value;
  for (Eigen::Index i = 0; i < k; ++i)
    linear.residual += (amplitude[i] - 1) / amplitude_deviation * linear.directions.col(e + c + i);

  // What scatters from condition to condition also drifts slowly within one, by half as much.
  std::vector<Eigen::VectorXd> tolerance;
  for (std::size_t m = 0; m < model.nuisances().size(); ++m) {
    const bool off = what.nuisance == static_cast<int>(m);
    Eigen::VectorXd drift = Eigen::VectorXd::Zero(n);
    for (Eigen::Index j = 0; j < e; ++j) {
      if (model.uncertain_inputs()[j].nuisance != static_cast<int>(m)) continue;
      drift += 0.5 * inputs.col(j);
      if (off) linear.directions.col(e + c + k) += widening * inputs.col(j);
    }
    if (model.nuisances()[m].each_condition && model.nuisances()[m].relative) tolerance.push_back(drift);
  }
  for (Eigen::Index i = 0; i < k; ++i) tolerance.push_back(form_tolerance * amplitude[i] * now.slope.col(i));
  linear.tolerance.resize(n, static_cast<Eigen::Index>(tolerance.size()));
  for (std::size_t t = 0; t < tolerance.size(); ++t)
    linear.tolerance.col(static_cast<Eigen::Index>(t)) = tolerance[t];
  return linear;
}

Weighed Weighing::weigh(const Hypothesis& what, const std::vector<bool>& use, bool joint,
                        const NoiseChains& chains) {
  Weighed best;
  best.what = what;
  for (std::size_t i = 0; i < what.set.size(); ++i)
    if (!responses.ok({what.set[i]})) best.possible = false;
  if (joint && best.possible && !what.set.empty()) best.possible = responses.ok(what.set);
  if (!best.possible) return best;
  const Eigen::Index first = first_amplitude();
  std::vector<double> amplitude(what.set.size(), 1.0);
  LinearModel linear = linearise(what, amplitude, joint);
  double stated = 1;  // chi2/n with the noise as stated
  const auto score_with = [&](const NoiseVariant& variant) {
    LinearFit now;
    for (int iteration = 0; iteration < 4; ++iteration) {
      now = WhitenedModel(noise, variant, linear, use).brief();
      double moved = 0;
      for (std::size_t i = 0; i < amplitude.size(); ++i) {
        const double a =
            std::clamp(1 + amplitude_deviation * now.mean[first + static_cast<Eigen::Index>(i)], 0.05, 1.95);
        moved = std::max(moved, std::abs(a - amplitude[i]));
        amplitude[i] = a;
      }
      if (moved < 0.02) break;
      linear = linearise(what, amplitude, joint);
    }
    const double score = now.log_evidence - price(what) - (variant.as_stated() ? 0.0 : price_of_noise);
    if (variant.as_stated())
      best.score_as_stated = score, best.chi2_as_stated = stated = now.chi2 / now.points;
    if (score > best.score)
      best.score = score, best.noise = variant, best.amplitude = amplitude, best.linear = linear;
    return score;
  };
  // Along a chain of growing noise the evidence has one top: the search begins at the end that the scatter
  // suggests, and stops below the top.
  for (const std::vector<NoiseVariant>& chain : chains) {
    double top = -1e300;
    for (std::size_t i = 0; i < chain.size(); ++i) {
      const double score = score_with(stated > far_off ? chain[chain.size() - 1 - i] : chain[i]);
      if (score < top - well_below) break;
      top = std::max(top, score);
    }
  }
  best.fit = WhitenedModel(noise, best.noise, best.linear, use).full();
  for (std::size_t i = 0; i < amplitude.size(); ++i) {
    const Eigen::Index c = first + static_cast<Eigen::Index>(i);
    best.deviation.push_back(amplitude_deviation * std::sqrt(best.fit.covariance(c, c)));
  }
  return best;
}

}  // namespace seedflow
