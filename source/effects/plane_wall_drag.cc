#include <algorithm>
#include <cmath>

#include "seedflow/effects/definitions.h"
#include "seedflow/effects/drag_laws.h"

namespace seedflow {
namespace {

/// Brenner's exact series for motion towards a plane, s = (h - R)/R > 0; its terms fall like exp(-2 n alpha).
/// Close to the wall, where it needs many terms, the lubrication expansion of Cox & Brenner (within 1e-4 at s
/// = 0.01).
double normal_factor(double s) {
  if (s < 0.01) return 1 / s - 0.2 * std::log(s) + 0.971264;
  const double alpha = std::acosh(1 + s), sinh1 = std::sinh(alpha), sinh2 = std::sinh(2 * alpha);
  double sum = 0;
  for (int n = 1; (2 * n + 1) * alpha < 50; ++n) {
    const double m = 2 * n + 1, half = 2 * std::sinh(0.5 * m * alpha), narrow = m * sinh1;
    const double term = (2 * std::sinh(m * alpha) + m * sinh2) / (half * half - narrow * narrow) - 1;
    sum += n * (n + 1.0) / ((m - 2) * (m + 2)) * term;
  }
  return 4.0 / 3 * sinh1 * sum;
}

/// Faxen's series for motion along a plane, and near contact the lubrication form of Goldman, Cox and
/// Brenner, which is the larger of the two below s = 0.03. Within 1.5 % of the exact solution.
double tangential_factor(double s) {
  const double x = 1 / (1 + s), x3 = x * x * x;
  const double series = 1 / (1 - 9.0 / 16 * x + x3 / 8 - 45.0 / 256 * x3 * x - x3 * x * x / 16);
  const double lubrication = -8.0 / 15 * std::log(s) + 0.9588;
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
      "0.9588 - 8/15 ln s), x = 1/(1 + s). Form Lubrication: the film alone, whatever Re outside it, F = 3 "
      "pi mu d "
      "(g_n(s) - g_n(s_r)) w_n for s < s_r = Reach";
  r.numbers = {{"Smallest gap", 1e-3, "1", Range::between(1e-6, 0.1),
                "s is not taken smaller than this: the roughness of the surfaces, in radii."},
               {"Reach", 0.05, "1", Range::between(1e-3, 1),
                "Of the form Lubrication: gap in radii below which the film acts."}};
  r.choices = {
      {"Form",
       "Whole",
       {"Whole", "Lubrication"},
       "The wall's whole influence in Stokes flow, or the thin film alone, where the flow outside it "
       "is resolved or is not Stokes flow."}};
  r.references = {
      "Brenner (1961), Chem. Eng. Sci. 16, 242-251, doi:10.1016/0009-2509(61)80035-3",
      "Cox & Brenner (1967), Chem. Eng. Sci. 22, 1753-1777",
      "Goldman, Cox & Brenner (1967), Chem. Eng. Sci. 22, 637-651, doi:10.1016/0009-2509(67)80047-2",
      "Costa, Boersma, Westerweel & Breugem (2015), Phys. Rev. E 92, 053012, doi:10.1103/PhysRevE.92.053012 "
      "(the film alone; gap of 0.05 radii at a wall)"};
  r.validity =
      "one plane wall, Re << 1 (used as a first estimate up to Re = 1), wall and fluid at rest far away";
  r.in_range = [](const FlowAtBody& flow) { return slip_reynolds(flow) < 1; };
  r.signature = "measured speed falls before the wall is reached, simulated speed does not";
  return {r, [](const EffectSettings& settings) {
            const double smallest = settings.numbers[0], reach = settings.numbers[1];
            const bool film = settings.choices[0] == "Lubrication";
            return [=](const FlowAtBody& flow, EffectMemory&, BodyForce& force) {
              const double gap = std::max(2 * flow.wall_distance / flow.diameter - 1, smallest);
              // Beyond 1e4 radii both factors differ from 1 by less than 2e-4; without a normal there is no
              // wall.
              if (gap > 1e4 || norm_square(flow.wall_normal) == 0) return;
              if (film) {
                if (gap >= reach) return;
                const double excess = normal_factor(gap) - normal_factor(reach);
                const double stokes = 3 * M_PI * flow.viscosity * flow.diameter;
                const Vec3 w = slip(flow), across = dot(w, flow.wall_normal) * flow.wall_normal;
                force.drag_coefficient += stokes * excess;  // implicit; taken back along the wall
                force.force -= stokes * excess * (w - across);
                return;
              }
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
