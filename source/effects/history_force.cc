#include <cmath>

#include "seedflow/effects/definitions.h"
#include "seedflow/effects/drag_laws.h"
#include "seedflow/effects/history_kernel.h"

namespace seedflow {
namespace {

// Memory: the flow velocity at the last step (3), its rate along the path (3), then the record of the slip.
constexpr int header = 6;

void remember(const FlowAtBody& flow, EffectMemory& memory, double resolution) {
  if (!(flow.time_step > 0))
    throw RunError("Effect 'History force': the time step is " + std::to_string(flow.time_step) +
                   " s. Remedy: whoever moves the bodies must tell the step about to be taken.");
  const bool fresh = memory.empty();
  if (fresh) memory.assign(header, 0.0);
  ThinnedHistory record(memory, header, 3);
  const double last = fresh ? 0 : record.time(record.size() - 1);
  if (!fresh && flow.time <= last) {
    if (flow.time < last - 1e-9 * flow.time_step)
      throw RunError("Effect 'History force': time went back from " + std::to_string(last) + " s to " +
                     std::to_string(flow.time) +
                     " s. Remedy: resume from a checkpoint instead of repeating steps.");
    return;
  }
  for (int c = 0; c < 3; ++c) {
    memory[3 + c] =
        fresh ? flow.flow_acceleration[c] : (flow.flow_velocity[c] - memory[c]) / (flow.time - last);
    memory[c] = flow.flow_velocity[c];
  }
  const Vec3 w = slip(flow);
  record.append(flow.time, &w.x, resolution);
}

}  // namespace

EffectDefinition history_force() {
  EffectRecord r;
  r.name = "History force";
  r.slot = "force on a body";
  r.summary = "Viscous memory of past changes of the slip (Basset force).";
  r.equation =
      "F = 3/2 d^2 sqrt(pi rho mu) integral K(t - s) dw/ds ds, w = u - v. Basset: K = 1/sqrt(t). Mei-Adrian "
      "and "
      "Dorgan-Loth: K = sqrt(pi nu/R^2) ((pi nu t/R^2)^(1/2c) + (pi/2 |w|^3 t^2/(R nu f_H^3))^(1/c))^-c, f_H "
      "= 0.75 + "
      "c2 Re, with c = 2, c2 = 0.105 and c = 2.5, c2 = 0.2; R = d/2";
  r.numbers = {
      {"Resolution", 16, "1", Range::between(4, 1000),
       "Samples of the past are kept at distances of age/Resolution: memory and work grow like it, the error "
       "falls like its square."}};
  r.choices = {{"Kernel",
                "Dorgan-Loth",
                {"Dorgan-Loth", "Mei-Adrian", "Basset"},
                "Finite-Re kernels with the slip of the moment, or the exact kernel of Stokes flow."},
               {"First slip",
                "Impulsive",
                {"Impulsive", "Established"},
                "Whether the slip at first sight arose that moment, or had been there for ever."}};
  r.references = {
      "Basset (1888), A Treatise on Hydrodynamics, vol. 2",
      "Mei & Adrian (1992), J. Fluid Mech. 237, 323-341, doi:10.1017/S0022112092003434",
      "Dorgan & Loth (2007), Int. J. Multiphase Flow 33, 833-848, doi:10.1016/j.ijmultiphaseflow.2007.02.005",
      "van Hinsberg, ten Thije Boonkkamp & Clercx (2011), J. Comput. Phys. 230, 1465-1478, "
      "doi:10.1016/j.jcp.2010.11.014 (the need for bounded memory)"};
  r.validity =
      "lone sphere; Basset Re < 1, finite-Re kernels up to a few hundred; not much denser than the fluid";
  r.in_range = [](const FlowAtBody& flow) { return slip_reynolds(flow) < 400 && flow.void_fraction > 0.9; };
  r.signature =
      "measured approach to the terminal speed slower than simulated, with a long tail; same terminal speed";
  r.has_memory = true;
  return {r, [](const EffectSettings& settings) {
            const double resolution = settings.numbers[0];
            const std::string kernel_name = settings.choices[0];
            const bool basset = kernel_name == "Basset", impulsive = settings.choices[1] == "Impulsive";
            const double c = kernel_name == "Mei-Adrian" ? 2 : 2.5,
                         c2 = kernel_name == "Mei-Adrian" ? 0.105 : 0.2;
            return [=](const FlowAtBody& flow, EffectMemory& memory, BodyForce& force) {
              remember(flow, memory, resolution);
              const double nu = flow.viscosity / flow.density, d = flow.diameter;
              const HistoryKernel kernel =
                  basset ? HistoryKernel() : finite_reynolds_kernel(d, nu, norm(slip(flow)), c, c2);
              const double strength = 1.5 * d * d * std::sqrt(M_PI * flow.density * flow.viscosity);
              const ThinnedHistory record(memory, header, 3);
              // The slip changes by du/dt - dv/dt within the step; the second part is implicit.
              const double newest = kernel.newest(flow.time_step);
              const Vec3 flow_rate = {memory[3], memory[4], memory[5]};
              force.force += strength * (history_integral(kernel, record, flow.time_step, impulsive) +
                                         newest * flow_rate);
              force.added_mass += strength * newest;
            };
          }};
}

}  // namespace seedflow
