#include <cmath>
#include <limits>

#include "seedflow/effects/definitions.h"

namespace seedflow {
namespace {

/// Unit vector, or zero.
Vec3 direction(const Vec3& v) {
  const double length = norm(v);
  return length > 0 ? v / length : Vec3{};
}

/// The numbers of the effect, in this order: coefficients, then exponents.
const std::vector<std::string> coefficients = {"Slip",      "Gravity",    "x",      "y",      "z",
                                               "Spin lift", "Shear lift", "Trap x", "Trap y", "Trap z"};
enum { slip_along, gravity_along, x_along, spin_lift = 5, shear_lift, trap_x, first_exponent = 10 };
const std::vector<std::string> exponents = {"Reynolds number", "Spin ratio",     "Wall ratio",
                                            "Tube ratio",      "Solid fraction", "shear Reynolds number"};

}  // namespace

EffectDefinition inferred_law() {
  EffectRecord r;
  r.name = "Inferred law";
  r.slot = "force on a body";
  r.summary = "A force found by the diagnosis, a product of powers of dimensionless groups.";
  r.equation =
      "F = P (c_s k w + 3 pi mu d |w| (c_m e_m + c_v e_v) + m (c_g g + |g| sum_i (c_i + t_i x_i/d) e_i)), "
      "w = u - v, k the drag coefficient of the effects above, e_m along W x w with W = curl u/2 - "
      "omega_body, "
      "e_v along w x curl u; P = Re^a S^b (d/h)^c (d/D)^d (1 - eps)^e Re_s^f, Re = rho d |w|/mu, "
      "S = d |W|/(2 |w|), h distance of the wall, D diameter of the tube, Re_s = rho d^2 |curl u|/mu";
  for (const std::string& name : coefficients)
    r.numbers.push_back({"Coefficient " + name, 0, "1", Range::between(-1e12, 1e12),
                         "Of the direction " + name + ", in units of drag, Stokes drag or weight."});
  for (const std::string& name : exponents)
    r.numbers.push_back(
        {"Exponent " + name, 0, "1", Range::between(-6, 6), "Power of the group " + name + "."});
  r.references = {"found from data; see doc/diagnosis.md"};
  r.validity = "the range of the data it was inferred from";
  r.in_range = [](const FlowAtBody&) { return true; };
  r.signature = "whatever it was inferred from";
  const auto law = [](const EffectSettings& settings) {
    const std::vector<double> n = settings.numbers;
    return [n](const FlowAtBody& flow, EffectMemory&, BodyForce& force) {
      const Vec3 w = slip(flow), spin = 0.5 * flow.flow_vorticity - flow.angular_velocity;
      const double tiny = std::numeric_limits<double>::min(), speed = std::max(norm(w), tiny);
      const double d = flow.diameter, g = norm(flow.gravity), nu = flow.viscosity / flow.density;
      const double group[] = {d * speed / nu,         d * norm(spin) / (2 * speed),
                              d / flow.wall_distance, d / flow.tube_diameter,
                              1 - flow.void_fraction, d * d * norm(flow.flow_vorticity) / nu};
      double power = 1;
      for (std::size_t i = 0; i < exponents.size(); ++i)
        if (n[first_exponent + i] != 0) power *= std::pow(std::max(group[i], tiny), n[first_exponent + i]);
      const Vec3 lift =
          n[spin_lift] * direction(cross(spin, w)) + n[shear_lift] * direction(cross(w, flow.flow_vorticity));
      Vec3 body = n[gravity_along] * flow.gravity;
      for (int i = 0; i < 3; ++i) body[i] += g * (n[x_along + i] + n[trap_x + i] * flow.position[i] / d);
      force.force += power * (3 * M_PI * flow.viscosity * d * speed * lift + flow.mass * body);
      force.drag_coefficient *= 1 + power * n[slip_along];
    };
  };
  return {r, law};
}

}  // namespace seedflow
