#include "seedflow/experiment/settling_reference.h"

#include <cmath>

#include "seedflow/effects/drag_laws.h"
#include "seedflow/effects/single_body.h"

namespace seedflow::settling_reference {

namespace {

double seed_volume(const SimulationParameters& p) {
  return M_PI / 6.0 * std::pow(p.seeds.model.diameter, 3);
}

double net_weight(const SimulationParameters& p, double buoyant_volume) {
  return (p.seeds.model.density * seed_volume(p) - p.air.density * buoyant_volume) * norm(p.dem.gravity);
}

}  // namespace

std::vector<double> table_5(int n) {
  switch (n) {
    case 164:
      return {0.198, 0.290, 0.293, 0.293};
    case 109:
      return {0.195, 0.285, 0.287, 0.288};
    case 70:
      return {0.193, 0.282, 0.285, 0.285};
    case 50:
      return {0.189, 0.276, 0.279, 0.279};
    case 36:
      return {0.185, 0.271, 0.274, 0.274};
    default:
      return {};
  }
}

double stokes_speed(const SimulationParameters& p) {
  const double r = 0.5 * p.seeds.model.diameter;
  return 2.0 / 9.0 * r * r * norm(p.dem.gravity) * (p.seeds.model.density - p.air.density) / p.air.viscosity;
}

double sphere_speed(const SimulationParameters& p) {
  return terminal_speed(drag_law("Schiller-Naumann"), net_weight(p, seed_volume(p)), p.seeds.model.diameter,
                        p.air.density, p.air.viscosity);
}

double literal_one_way_speed(const SimulationParameters& p, double sub_sphere_diameter,
                             double buoyant_volume) {
  const DragLaw& law = drag_law(p.effects["Drag"].choice("Law"));
  return terminal_speed(law, net_weight(p, buoyant_volume) / p.seeds.model.n_spheres, sub_sphere_diameter,
                        p.air.density, p.air.viscosity);
}

std::vector<double> sphere_start(const SimulationParameters& p, const std::vector<double>& times) {
  PrescribedFlow flow;
  flow.density = p.air.density;
  flow.viscosity = p.air.viscosity;
  flow.gravity = p.dem.gravity;
  EffectSet effects;
  effects["Added mass"].set_strength(1);
  effects["History force"].set_strength(1);
  effects.prepare();
  SingleBody body({p.seeds.model.diameter, p.seeds.model.density}, flow, effects);
  std::vector<double> speeds;
  for (const SingleBodyState& state : body.run(times, 1e-4)) speeds.push_back(norm(state.velocity));
  return speeds;
}

}  // namespace seedflow::settling_reference
