#include "seedflow/fluid/prescribed_air.h"

#include <deal.II/base/function_parser.h>

#include <cctype>
#include <cmath>
#include <limits>
#include <vector>

namespace seedflow {

void PrescribedAirParameters::declare(Parameters& p) {
  const auto section = p.section("Prescribed", "A flow given by expressions (with Air/Model = prescribed).");
  const char* names[] = {"Velocity x", "Velocity y", "Velocity z"};
  for (int d = 0; d < 3; ++d)
    p.text(names[d], velocity[d], "Expression of x, y, z [m] and t [s], in m/s, e.g. 0.1*sin(2*pi*t).");
  p.number("Length scale", length_scale, "m", Range::positive(),
           "Size of the finest structure of the expressions; derivatives are taken over a thousandth of it.");
  p.number("Time scale", time_scale, "s", Range::positive(),
           "Time of the fastest change of the expressions; derivatives are taken over a thousandth of it.");
}

namespace {

/// Whether the expression has this name: as a whole, or at the beginning of a longer one.
bool mentions(const std::string& expression, const std::string& name, bool whole = true) {
  const auto in_name = [&](std::size_t i) {
    return i < expression.size() && (std::isalnum(expression[i]) || expression[i] == '_');
  };
  for (std::size_t i = expression.find(name); i != std::string::npos; i = expression.find(name, i + 1))
    if ((i == 0 || !in_name(i - 1)) && !(whole && in_name(i + name.size()))) return true;
  return false;
}

/// One component. Evaluated anew only if something has changed that its expression mentions: of the nine
/// points that derivatives take, most then cost nothing.
class Component {
 public:
  explicit Component(const std::string& text) : parser(1), random(mentions(text, "rand", false)) {
    parser.initialize("x,y,z,t", text, {{"pi", M_PI}}, true);
    const char* const names[] = {"x", "y", "z", "t"};
    for (int i = 0; i < 4; ++i) depends[i] = mentions(text, names[i]);
    last.fill(std::numeric_limits<double>::quiet_NaN());
  }

  double operator()(const std::array<double, 4>& at) {
    bool same = !random && known;
    for (int i = 0; i < 4; ++i) same = same && (!depends[i] || at[i] == last[i]);
    if (same) return value;
    parser.set_time(at[3]);
    value = parser.value({at[0], at[1], at[2]});
    last = at, known = true;
    return value;
  }

 private:
  dealii::FunctionParser<3> parser;
  bool random, known = false;
  std::array<bool, 4> depends{};
  std::array<double, 4> last;
  double value = 0;
};

}  // namespace

struct PrescribedAir::Expressions {
  std::vector<std::unique_ptr<Component>> component;
};

PrescribedAir::PrescribedAir(const PrescribedAirParameters& p, double density, double viscosity)
    : expressions(std::make_unique<Expressions>()),
      density(density),
      viscosity(viscosity),
      length_step(1e-3 * p.length_scale),
      time_step(1e-3 * p.time_scale) {
  for (int d = 0; d < 3; ++d) {
    const std::string entry = std::string("Air/Prescribed/Velocity ") + "xyz"[d];
    try {
      expressions->component.push_back(std::make_unique<Component>(p.velocity[d]));
      if (!std::isfinite((*expressions->component[d])({0, 0, 0, 0})))
        throw InputError("not finite at x = y = z = t = 0");
    } catch (const std::exception& error) {
      throw InputError(
          entry + ": the expression \"" + p.velocity[d] + "\" cannot be used: " + error.what() +
          "\nAllowed: numbers, x, y, z, t, pi, + - * / ^, sin, cos, exp, sqrt, if(a<b,c,d), ...");
    }
  }
}
PrescribedAir::~PrescribedAir() = default;
PrescribedAir::PrescribedAir(PrescribedAir&&) noexcept = default;

Vec3 PrescribedAir::velocity(const Vec3& x, double time) const {
  const std::array<double, 4> at = {x.x, x.y, x.z, time};
  const auto& u = expressions->component;
  return {(*u[0])(at), (*u[1])(at), (*u[2])(at)};
}

FlowAtPoint PrescribedAir::at(const Vec3& x, double time) const {
  FlowAtPoint f;
  f.velocity = velocity(x, time);
  f.acceleration = (velocity(x, time + time_step) - velocity(x, time - time_step)) / (2 * time_step);
  Vec3 gradient[3];  // gradient[d] = du/dx_d
  Vec3 laplacian;
  for (int d = 0; d < 3; ++d) {
    Vec3 step;
    step[d] = length_step;
    const Vec3 ahead = velocity(x + step, time), behind = velocity(x - step, time);
    gradient[d] = (ahead - behind) / (2 * length_step);
    laplacian += (ahead - 2.0 * f.velocity + behind) / (length_step * length_step);
    f.acceleration += f.velocity[d] * gradient[d];
  }
  f.vorticity = {gradient[1].z - gradient[2].y, gradient[2].x - gradient[0].z, gradient[0].y - gradient[1].x};
  f.pressure_gradient = viscosity * laplacian - density * f.acceleration;
  return f;
}

}  // namespace seedflow
