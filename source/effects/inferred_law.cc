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

enum { slip_along, gravity_along, x_along, y_along, z_along, spin_lift, shear_lift, n_directions };

}  // namespace

EffectDefinition inferred_law() {
  EffectRecord r;
  r.name = "Inferred law";
  r.slot = "force on a body";
  r.summary =
      "A force found from measurements by the diagnosis, a product of powers of dimensionless groups.";
  r.equation =
      "F = P (k (c_s w + |w| (c_m e_m + c_v e_v)) + m (c_g g + |g| (c_x e_x + c_y e_y + c_z e_z))), w = u - "
      "v, "
      "k the drag coefficient of the effects above, e_m along W x w with W = curl u/2 - omega_body, e_v "
      "along "
      "w x curl u; P = Re^a (d|W|/2|w|)^b (d/h)^c (d/D)^d (1 - eps)^e, Re = rho d |w|/mu, h distance of the "
      "wall, D diameter of the tube";
  const char* along[n_directions] = {"Slip", "Gravity", "x", "y", "z", "Spin lift", "Shear lift"};
  for (const char* name : along)
    r.numbers.push_back({std::string("Coefficient ") + name, 0, "1", Range::between(-1e6, 1e6),
                         std::string("c of the direction: ") + name + "."});
  for (const char* name : {"Reynolds number", "Spin ratio", "Wall ratio", "Tube ratio", "Solid fraction"})
    r.numbers.push_back({std::string("Exponent ") + name, 0, "1", Range::between(-6, 6),
                         std::string("Power of the group: ") + name + "."});
  r.references = {"found from data; see doc/diagnosis.md"};
  r.validity = "the range of the data it was inferred from";
  r.in_range = [](const FlowAtBody&) { return true; };
  r.signature = "whatever it was inferred from";
  return {
      r, [](const EffectSettings& settings) {
        const std::vector<double> n = settings.numbers;
        return [n](const FlowAtBody& flow, EffectMemory&, BodyForce& force) {
          const Vec3 w = slip(flow);
          const double speed = norm(w), tiny = std::numeric_limits<double>::min();
          if (speed == 0) return;
          const Vec3 spin = 0.5 * flow.flow_vorticity - flow.angular_velocity;
          const double group[5] = {
              flow.density * flow.diameter * speed / flow.viscosity, flow.diameter * norm(spin) / (2 * speed),
              flow.diameter / flow.wall_distance, flow.diameter / flow.tube_diameter, 1 - flow.void_fraction};
          double power = 1;
          for (int i = 0; i < 5; ++i)
            if (n[n_directions + i] != 0) power *= std::pow(std::max(group[i], tiny), n[n_directions + i]);
          const double k = force.drag_coefficient, g = norm(flow.gravity);
          const Vec3 lift = n[spin_lift] * direction(cross(spin, w)) +
                            n[shear_lift] * direction(cross(w, flow.flow_vorticity));
          const Vec3 body = n[gravity_along] * flow.gravity + g * Vec3{n[x_along], n[y_along], n[z_along]};
          force.drag_coefficient += power * n[slip_along] * k;
          force.force += power * (k * speed * lift + flow.mass * body);
        };
      }};
}

}  // namespace seedflow
