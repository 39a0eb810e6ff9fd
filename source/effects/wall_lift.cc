#include <cmath>

#include "seedflow/effects/definitions.h"
#include "seedflow/effects/drag_laws.h"

namespace seedflow {
namespace {

/// Lift coefficient C_L = F/(pi/8 rho d^2 w^2) over L = h w/nu: the fit of Takemura and Magnaudet to the
/// theory of Vasseur and Cox, whose limits are 9/8 near the wall and 4.5 L^-2 (1 + 2.219 L^-1/2) far from it.
double coefficient(double l) {
  return l < 10 ? (9.0 / 8 + 5.78e-6 * std::pow(l, 4.58)) * std::exp(-0.292 * l) : 8.94 * std::pow(l, -2.09);
}

}  // namespace

EffectDefinition wall_lift() {
  EffectRecord r;
  r.name = "Wall lift";
  r.slot = "force on a body";
  r.summary = "Push away from a plane wall on a body that slips along it.";
  r.equation =
      "F = pi/8 rho d^2 C_L w_t^2 n, w_t slip along the wall, n its normal, h distance of the centre, L = h "
      "w_t/nu; C_L = (9/8 + 5.78e-6 L^4.58) exp(-0.292 L) for L < 10, 8.94 L^-2.09 above";
  r.references = {
      "Vasseur & Cox (1977), J. Fluid Mech. 80, 561-591",
      "Takemura & Magnaudet (2003), J. Fluid Mech. 495, 235-253 (the fit; bubbles that behave as solid "
      "spheres)",
      "Cherukat & McLaughlin (1994), J. Fluid Mech. 263, 1-18, doi:10.1017/S0022112094004015 (near the "
      "wall)"};
  r.validity = "Re < 1 (fluid at rest or sheared so little that Saffman's force is apart), one plane wall";
  r.in_range = [](const FlowAtBody& flow) { return slip_reynolds(flow) < 1; };
  r.signature = "bodies settling along a wall drift away from it, fastest close to the wall";
  return {r, [](const EffectSettings&) {
            return [](const FlowAtBody& flow, EffectMemory&, BodyForce& force) {
              if (norm_square(flow.wall_normal) == 0) return;
              const Vec3 w = slip(flow);
              const double speed = norm(w - dot(w, flow.wall_normal) * flow.wall_normal);
              if (speed == 0) return;
              const double l = flow.wall_distance * speed * flow.density / flow.viscosity;
              const double d = flow.diameter;
              force.force +=
                  (M_PI / 8 * flow.density * d * d * speed * speed * coefficient(l)) * flow.wall_normal;
            };
          }};
}

}  // namespace seedflow
