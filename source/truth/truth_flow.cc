#include "seedflow/truth/truth_flow.h"

#include <cmath>
#include <sstream>

namespace seedflow {

Vec3 TruthFlow::velocity(const Vec3& x, double t) const {
  return uniform + std::sin(frequency * t) * amplitude + Vec3{0, 0, (shear + curvature * x.x) * x.x};
}

Vec3 TruthFlow::rate(double t) const {
  return (frequency * std::cos(frequency * t)) * amplitude;
}

Vec3 TruthFlow::rate_along(const Vec3& x, double t, const Vec3& v) const {
  return rate(t) + Vec3{0, 0, (shear + 2 * curvature * x.x) * v.x};
}

Vec3 TruthFlow::vorticity(const Vec3& x) const {
  return {0, -(shear + 2 * curvature * x.x), 0};
}

Vec3 TruthFlow::laplacian() const {
  return {0, 0, 2 * curvature};
}

std::array<std::string, 3> TruthFlow::expressions() const {
  std::array<std::string, 3> texts;
  for (int d = 0; d < 3; ++d) {
    std::ostringstream text;
    text.precision(17);
    const auto add = [&](double factor, const char* rest) {
      if (factor != 0) text << (text.tellp() > 0 ? " + " : "") << '(' << factor << ')' << rest;
    };
    add(uniform[d], "");
    if (amplitude[d] != 0) {
      std::ostringstream wave;
      wave.precision(17);
      wave << " * sin(" << frequency << " * t)";
      add(amplitude[d], wave.str().c_str());
    }
    if (d == 2) add(shear, " * x"), add(curvature, " * x * x");
    texts[d] = text.str().empty() ? "0" : text.str();
  }
  return texts;
}

}  // namespace seedflow
