#include "seedflow/truth/truth_laws.h"

#include <algorithm>
#include <cmath>

namespace seedflow {

double truth_drag(double re) {
  return 1 + 0.150 * std::pow(re, 0.681) + 0.407 * re / 24 * re / (re + 8710);
}

double truth_shape_factor(double re, double phi) {
  const auto factor = [re](double p) {
    const double low = std::exp(2.3288 - 6.4581 * p + 2.4486 * p * p) * std::pow(re, 0.0964 + 0.5565 * p);
    const double limit = std::exp(4.9050 - 13.8944 * p + 18.4222 * p * p - 10.2599 * p * p * p);
    const double half = std::exp(1.4681 + 12.2584 * p - 20.7322 * p * p + 15.8855 * p * p * p);
    return 1 + low + re / 24 * limit / (1 + half / re);
  };
  return factor(phi) / factor(1);
}

double truth_crowd_factor(double re, double eps) {
  return truth_drag(eps * re) / truth_drag(re) * std::pow(eps, -2.65);
}

double truth_tube_factor(double x) {
  const double above = 1 - 0.75857 * std::pow(x, 5);
  const double below =
      1 - 2.1050 * x + 2.0865 * std::pow(x, 3) - 1.7068 * std::pow(x, 5) + 0.72603 * std::pow(x, 6);
  return above / below;
}

double truth_approach_factor(double gap) {
  return (6 * gap * gap + 9 * gap + 2) / (6 * gap * gap + 2 * gap);
}

double truth_along_factor(double x) {
  return 1 - 8.0 / 15 * std::log(1 - x) + x * (0.029 + x * (0.04973 - x * 0.1249));
}

double truth_shear_lift(double e) {
  return std::pow(1 + 0.2 / (e * e), -1.5);
}

double truth_spin_lift(double re, double ratio) {
  const double fall = 0.675 + 0.15 * (1 + std::tanh(0.28 * (ratio - 2)));
  return 1 - fall * std::tanh(0.18 * std::sqrt(re));
}

double truth_wall_lift(double x) {
  return 1.7631 + x * (0.3561 + x * (-1.1837 + x * 0.845163));
}

}  // namespace seedflow
