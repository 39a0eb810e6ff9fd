#include "seedflow/diagnose/responses.h"

#include <Eigen/LU>
#include <cmath>

namespace seedflow {

namespace {

/// Values that a failed run left out count as unchanged here; ok() tells.
Eigen::VectorXd change(const Eigen::VectorXd& values, const Eigen::VectorXd& base) {
  Eigen::VectorXd d = values - base;
  for (Eigen::Index i = 0; i < d.size(); ++i)
    if (!std::isfinite(d[i])) d[i] = 0;
  return d;
}

constexpr double nodes[3] = {0.6, 1.0, 1.4};  // amplitudes of the cubic

Setting half_step() {
  Setting setting;
  setting.step_factor = 0.5;
  return setting;
}

}  // namespace

Setting Responses::at_full_strength(const std::vector<int>& set) {
  Setting setting;
  for (const int k : set) setting.amplitude[k] = 1;
  return setting;
}

Setting Responses::with_input(Setting setting, int nuisance) const {
  // Errors of one nuisance act in different conditions: one run of each condition shows them all.
  for (std::size_t e = 0; e < model.uncertain_inputs().size(); ++e)
    if (model.uncertain_inputs()[e].nuisance == nuisance) setting.error[static_cast<int>(e)] = input_step();
  return setting;
}

void Responses::prepare() {
  model.prepare_runs(settings());
}

std::vector<Setting> Responses::settings() const {
  std::vector<Setting> list = {{}};
  for (int k = 0; k < static_cast<int>(model.candidates().size()); ++k)
    for (const double a : nodes) {
      if ((frugal || model.candidates()[k].entries.empty()) && a != 1) continue;
      list.push_back({});
      list.back().amplitude[k] = a;
    }
  for (int m = 0; m < static_cast<int>(model.nuisances().size()); ++m)
    list.push_back(with_input(Setting(), m));
  if (model.can_halve_step()) list.push_back(half_step());
  return list;
}

void Responses::prepare(const std::vector<std::vector<int>>& sets) {
  std::vector<Setting> settings;
  for (const std::vector<int>& set : sets) {
    settings.push_back(at_full_strength(set));
    for (int m = 0; m < static_cast<int>(model.nuisances().size()) && !frugal; ++m)
      settings.push_back(with_input(at_full_strength(set), m));
  }
  model.prepare_runs(settings);
}

const Eigen::VectorXd& Responses::base() {
  if (base_values.size() == 0) base_values = model.predict({});
  return base_values;
}

const Eigen::VectorXd& Responses::full(const std::vector<int>& set) {
  auto& values = full_values[set];
  if (values.size() == 0) {
    values = model.predict(at_full_strength(set));
  }
  return values;
}

Eigen::VectorXd Responses::joint_rest(const std::vector<int>& set) {
  // Inclusion and exclusion over the proper subsets leaves what only the whole set does.
  Eigen::VectorXd rest = change(full(set), base());
  const unsigned all = (1u << set.size()) - 1;
  for (unsigned mask = 1; mask < all; ++mask) {
    std::vector<int> part;
    for (std::size_t i = 0; i < set.size(); ++i)
      if (mask & (1u << i)) part.push_back(set[i]);
    rest -= part.size() == 1 ? change(full(part), base()) : joint_rest(part);
  }
  return rest;
}

Responses::Value Responses::at(const std::vector<int>& set, const std::vector<double>& amplitude,
                               bool joint) {
  Value v;
  v.value = base();
  v.slope = Eigen::MatrixXd::Zero(base().size(), static_cast<Eigen::Index>(set.size()));
  for (std::size_t i = 0; i < set.size(); ++i) {
    auto& c = cubic[set[i]];
    const bool choice = model.candidates()[set[i]].entries.empty();
    if (c.size() == 0 && (frugal || choice)) {
      c = Eigen::MatrixXd::Zero(base().size(), 3);
      c.col(0) = change(full({set[i]}), base());
    } else if (c.size() == 0) {
      Eigen::Matrix3d powers;
      Eigen::MatrixXd values(base().size(), 3);
      for (int k = 0; k < 3; ++k) {
        powers.row(k) << nodes[k], nodes[k] * nodes[k], nodes[k] * nodes[k] * nodes[k];
        Setting setting;
        setting.amplitude[set[i]] = nodes[k];
        values.col(k) = change(nodes[k] == 1.0 ? full({set[i]}) : model.predict(setting), base());
      }
      c = values * powers.inverse().transpose();
    }
    const double a = amplitude[i];
    v.value += a * c.col(0) + a * a * c.col(1) + a * a * a * c.col(2);
    v.slope.col(static_cast<Eigen::Index>(i)) = c.col(0) + 2 * a * c.col(1) + 3 * a * a * c.col(2);
  }
  if (!joint) return v;
  for (unsigned mask = 3; mask < (1u << set.size()); ++mask) {
    std::vector<int> part;
    double product = 1;
    for (std::size_t i = 0; i < set.size(); ++i)
      if (mask & (1u << i)) part.push_back(set[i]), product *= amplitude[i];
    if (part.size() < 2) continue;
    const Eigen::VectorXd rest = joint_rest(part);
    v.value += product * rest;
    for (std::size_t i = 0; i < set.size(); ++i)
      if (mask & (1u << i)) v.slope.col(static_cast<Eigen::Index>(i)) += product / amplitude[i] * rest;
  }
  return v;
}

Eigen::MatrixXd Responses::inputs(const std::vector<int>& set, const std::vector<double>& amplitude) {
  if (frugal || set.empty()) return inputs_at_full_strength({});
  Eigen::MatrixXd columns = inputs_at_full_strength(set);
  for (std::size_t i = 0; i < set.size(); ++i)
    if (amplitude[i] != 1 && columns.size() > 0)
      columns += (amplitude[i] - 1) * (inputs_at_full_strength({set[i]}) - inputs_at_full_strength({}));
  return columns;
}

const Eigen::MatrixXd& Responses::inputs_at_full_strength(const std::vector<int>& set) {
  auto& columns = input_columns[set];
  if (columns.size() == 0) columns = inputs(at_full_strength(set));
  return columns;
}

Eigen::MatrixXd Responses::inputs(const Setting& about) {
  const Eigen::VectorXd reference = model.predict(about);
  Eigen::MatrixXd columns =
      Eigen::MatrixXd::Zero(reference.size(), static_cast<Eigen::Index>(model.uncertain_inputs().size()));
  for (std::size_t k = 0; k < model.nuisances().size(); ++k) {
    const Setting setting = with_input(about, static_cast<int>(k));
    const Eigen::VectorXd moved = change(model.predict(setting), reference) / input_step();
    for (const auto& [e, theta] : setting.error)
      for (Eigen::Index i = 0; i < moved.size(); ++i)
        if (model.uncertain_inputs()[e].applies[model.points()[i].condition]) columns(i, e) = moved[i];
  }
  return columns;
}

const Eigen::MatrixXd& Responses::numerics() {
  if (numerics_known) return numerical;
  numerics_known = true;
  if (!model.can_halve_step()) {
    numerical.setZero(base().size(), 0);
    return numerical;
  }
  const Eigen::VectorXd error = 4.0 / 3 * change(model.predict(half_step()), base());
  numerical.setZero(base().size(), static_cast<Eigen::Index>(model.conditions().size()));
  for (Eigen::Index i = 0; i < error.size(); ++i) numerical(i, model.points()[i].condition) = error[i];
  return numerical;
}

bool Responses::ok(const std::vector<int>& set) {
  const Eigen::VectorXd& values = full(set);
  for (Eigen::Index i = 0; i < values.size(); ++i)
    if (std::isfinite(base()[i]) && !std::isfinite(values[i])) return false;
  return true;
}

bool Responses::acts(int candidate) {
  const Eigen::VectorXd d = change(full({candidate}), base());
  for (Eigen::Index i = 0; i < d.size(); ++i)
    if (std::abs(d[i]) > 1e-12 * (std::abs(base()[i]) + 1e-30)) return true;
  return false;
}

}  // namespace seedflow
