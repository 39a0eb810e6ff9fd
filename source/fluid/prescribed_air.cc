#include "seedflow/fluid/prescribed_air.h"

#include <deal.II/base/function_parser.h>
#include <deal.II/lac/vector.h>

#include <cmath>

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

struct PrescribedAir::Expressions {
  dealii::FunctionParser<3> parser{3};
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
      dealii::FunctionParser<3> one(1);
      one.initialize("x,y,z,t", p.velocity[d], {{"pi", M_PI}}, true);
      if (!std::isfinite(one.value({0, 0, 0}))) throw InputError("not finite at x = y = z = t = 0");
    } catch (const std::exception& error) {
      throw InputError(
          entry + ": the expression \"" + p.velocity[d] + "\" cannot be used: " + error.what() +
          "\nAllowed: numbers, x, y, z, t, pi, + - * / ^, sin, cos, exp, sqrt, if(a<b,c,d), ...");
    }
  }
  expressions->parser.initialize("x,y,z,t", p.velocity[0] + ";" + p.velocity[1] + ";" + p.velocity[2],
                                 {{"pi", M_PI}}, true);
}
PrescribedAir::~PrescribedAir() = default;
PrescribedAir::PrescribedAir(PrescribedAir&&) noexcept = default;

Vec3 PrescribedAir::velocity(const Vec3& x, double time) const {
  expressions->parser.set_time(time);
  dealii::Vector<double> u(3);
  expressions->parser.vector_value({x.x, x.y, x.z}, u);
  return {u[0], u[1], u[2]};
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
