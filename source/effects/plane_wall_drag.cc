#include <algorithm>
#include <cmath>

#include "seedflow/effects/definitions.h"
#include "seedflow/effects/drag_laws.h"

namespace seedflow {
namespace {

/// Brenner's exact series for motion towards a plane, gap = (h - R)/R > 0. The terms fall like exp(-2 n
/// alpha).
double normal_factor(double gap) {
  const double alpha = std::acosh(1 + gap);
  const double sinh2 = std::sinh(2 * alpha), sinh1 = std::sinh(alpha);
  double sum = 0;
  const int last = static_cast<int>(std::ceil(25 / alpha)) + 5;
  for (int n = 1; n <= last; ++n) {
    const double m = 2 * n + 1, argument = m * alpha;
    // 2 sinh(m a)/(4 sinh^2(m a / 2) - ...) -> 1 for large arguments: no contribution left.
    if (argument > 60) break;
    const double half = 2 * std::sinh(0.5 * argument);
    const double term = (2 * std::sinh(argument) + m * sinh2) / (half * half - m * m * sinh1 * sinh1) - 1;
    sum += n * (n + 1.0) / ((2.0 * n - 1) * (2.0 * n + 3)) * term;
  }
  return 4.0 / 3 * sinh1 * sum;
}

/// Faxen's series for motion along a plane; near contact the lubrication form of Goldman, Cox and Brenner.
/// The larger of the two: the series lies above until gap = 0.02 and below from there on.
double tangential_factor(double gap) {
  const double x = 1 / (1 + gap), x3 = x * x * x;
  const double series = 1 / (1 - 9.0 / 16 * x + x3 / 8 - 45.0 / 256 * x3 * x - x3 * x * x / 16);
  const double lubrication = -8.0 / 15 * std::log(gap) + 0.9588;
  return std::max(series, lubrication);
}

}  // namespace

EffectDefinition plane_wall_drag() {
  EffectRecord r;
  r.name = "Plane wall drag";
  r.slot = "force on a body";
  r.summary = "More drag on a body near a plane wall, most of all when it moves towards the wall.";
  r.equation =
      "F = k (g_n w_n + g_t w_t), w slip, n normal and t along the wall, s = (h - d/2)/(d/2), h distance of "
      "the "
      "centre. g_n: Brenner's series, a = arcosh(1 + s), 4/3 sinh a sum n(n+1)/((2n-1)(2n+3)) ((2 "
      "sinh(2n+1)a + (2n+1) "
      "sinh 2a)/(4 sinh^2(n+1/2)a - (2n+1)^2 sinh^2 a) - 1). g_t = max(1/(1 - 9/16 x + x^3/8 - 45/256 x^4 - "
      "x^5/16), "
      "0.9588 - 8/15 ln s), x = 1/(1 + s)";
  r.numbers = {{"Smallest gap", 1e-3, "1", Range::between(1e-6, 0.1),
                "s is not taken smaller than this: the roughness of the surfaces, in radii."}};
  r.references = {
      "Brenner (1961), Chem. Eng. Sci. 16, 242-251, doi:10.1016/0009-2509(61)80035-3",
      "Goldman, Cox & Brenner (1967), Chem. Eng. Sci. 22, 637-651, doi:10.1016/0009-2509(67)80047-2"};
  r.validity =
      "one plane wall, Re << 1 (used as a first estimate up to Re = 1), wall and fluid at rest far away";
  r.in_range = [](const FlowAtBody& flow) { return slip_reynolds(flow) < 1; };
  r.signature = "measured speed falls before the wall is reached, simulated speed does not";
  return {r, [](const EffectSettings& settings) {
            const double smallest = settings.numbers[0];
            return [smallest](const FlowAtBody& flow, EffectMemory&, BodyForce& force) {
              const double gap = std::max(2 * flow.wall_distance / flow.diameter - 1, smallest);
              // From here on both factors differ from 1 by less than 1e-6; without a normal there is no wall.
              if (gap > 1.2e6 || norm_square(flow.wall_normal) == 0) return;
              const double normal = normal_factor(gap), along = tangential_factor(gap),
                           k = force.drag_coefficient;
              const Vec3 w = slip(flow), w_along = w - dot(w, flow.wall_normal) * flow.wall_normal;
              // The larger factor acts implicitly on all directions, the excess along the wall is taken back.
              force.drag_coefficient = k * normal;
              force.force -= k * (normal - along) * w_along;
            };
          }};
}

}  // namespace seedflow
