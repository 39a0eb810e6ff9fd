#include "seedflow/effects/model_effects.h"

#include "seedflow/effects/drag_laws.h"

namespace seedflow {
namespace {

const std::string source_paper = "Xu et al. (2024), Agriculture 14, 752, doi:10.3390/agriculture14050752";

EffectRecord choice_of_the_model(const std::string& name, const EffectEntry& entry) {
  EffectRecord r;
  r.name = name;
  r.slot = "choice of the model";
  r.in_range = [](const FlowAtBody&) { return true; };
  r.entry = entry;
  return r;
}

EffectRecord drag_shared_per_seed() {
  EffectRecord r = choice_of_the_model("Drag shared per seed", {"Coupling/Drag on", "sub-sphere", "seed"});
  r.summary = "The sub-spheres of a seed shield each other: one drag of the whole seed, shared among them.";
  r.equation =
      "F = k(d, u - v)(u - v) with d of the sphere of the seed's volume, shared by mass; without: sum over "
      "the "
      "n sub-spheres of k(d_i, u - v_i)(u - v_i), about n^(2/3) times as much at low Re";
  r.references = {source_paper + ", Eqs. 6 and 7 (without it)",
                  "Tran-Cong, Gay & Michaelides (2004), Powder Technol. 139, 21-32 (drag of glued spheres)"};
  r.validity = "seeds of several sub-spheres, closed bodies through which no air flows";
  r.signature = "all seeds too slow, the more so the finer they are divided";
  return r;
}

EffectRecord undisturbed_velocity() {
  EffectRecord r =
      choice_of_the_model("Undisturbed velocity", {"Coupling/Undisturbed velocity", "none", "oseen"});
  r.summary = "The drag is that of the flow as if the seed were absent, not of the flow it disturbs itself.";
  r.equation =
      "u - v = (<u> - v)/(1 + eps_p/3 - k M/(mu s)), <u> averaged by the exchange kernel, s its width, M(s "
      "|u - "
      "v|/nu) the mobility of a Gaussian force in Oseen flow";
  r.references = {"Horwitz & Mani (2016), J. Comput. Phys. 318, 85-109, doi:10.1016/j.jcp.2016.05.034",
                  "Evrard, Denner & van Wachem (2020), J. Comput. Phys. X 8, 100078"};
  r.validity =
      "drag on whole seeds, Gaussian exchange kernel wider than a cell, seeds farther from each other and "
      "from "
      "walls than its width; quasi-steady ('transient' remembers the path)";
  r.signature = "all seeds too fast, the more so the narrower the kernel and the lower Re";
  return r;
}

EffectRecord size_distribution() {
  EffectRecord r =
      choice_of_the_model("Size distribution", {"Filling/Diameter deviation", "0", "0.05", "Seeds/Diameter"});
  r.summary = "Seeds of one lot differ in size; at strength 1 their diameters by 5 % (standard deviation).";
  r.equation =
      "d normally distributed in five classes of equal number, standard deviation 0.05 a of the mean";
  r.references = {source_paper + ", section 3.2 (4.0 +- 0.1 mm)"};
  r.validity = "cleaned lots of one variety: deviation below a fifth of the mean, one maximum";
  r.signature = "denser fillings; small seeds below large ones, more passing a sieve of a tight fit";
  return r;
}

EffectRecord multi_contact_normalisation() {
  EffectRecord r = choice_of_the_model(
      "Multi-contact normalisation", {"Seeds motion/Contacts/Normalise multiple contacts", "false", "true"});
  r.summary = "Contacts between the same two seeds act as one: not stiffer for being divided.";
  r.equation = "k_i -> k_i/n, C_i -> C_i/n for the n sub-sphere contacts of one pair of seeds";
  r.references = {
      "Kruggel-Emden, Rickelt, Wirtz & Scherer (2008), Powder Technol. 188, 153-165, "
      "doi:10.1016/j.powtec.2008.04.037"};
  r.validity = "rigid clumps of sub-spheres; without any action on plain spheres";
  r.signature = "contact times, rebound and overlaps that depend on the number of sub-spheres";
  return r;
}

}  // namespace

EffectDefinition air_drag() {
  const DragLaw& law = drag_law("Schiller-Naumann");
  EffectRecord r;
  r.name = "Air drag";
  r.slot = "seeds without computed air";
  r.summary = "Drag of the still air in experiments called dry: heap, sieve, drum.";
  r.equation = "F = -k v, k = 3 pi mu d f(Re), Re = rho d |v|/mu, d of the sphere of the seed's volume; " +
               law.equation;
  r.numbers = {{"Density", 1.2, "kg/m3", Range::positive(), "Of the air."},
               {"Dynamic viscosity", 1.8e-5, "Pa s", Range::positive(), "Of the air."}};
  r.references = {law.reference};
  r.validity =
      "seeds that fly or roll singly through air at rest, Re < 1000 within 5 %; within a flowing bed the air "
      "goes along, and the effect is an upper bound";
  r.in_range = [](const FlowAtBody& flow) { return slip_reynolds(flow) < 2e5; };
  r.signature = "light, small or fast seeds that fly less far and fall more slowly";
  return {r, [&law](const EffectSettings&) {
            return [&law](const FlowAtBody& flow, EffectMemory&, BodyForce& force) {
              force.drag_coefficient += momentum_exchange(law, flow);
            };
          }};
}

std::vector<EffectRecord> model_effect_records() {
  return {drag_shared_per_seed(), undisturbed_velocity(), size_distribution(), multi_contact_normalisation(),
          air_drag().record};
}

}  // namespace seedflow
