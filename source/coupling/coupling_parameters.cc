#include "seedflow/coupling/coupling_parameters.h"

namespace seedflow {

void CouplingParameters::declare(Parameters& p) {
  const auto section = p.section("Coupling", "How seeds and air see each other.");
  p.choice(
      "Drag on", drag_on, {"seed", "sub-sphere"},
      "What is dragged as one body. 'sub-sphere' is the source paper's literal reading: every sub-sphere is "
      "dragged as if it were alone (Eqs. 6-7). 'seed' computes the drag of the whole seed once and shares it "
      "over its sub-spheres.");
  p.choice(
      "Exchange kernel", exchange_kernel, {"gaussian", "cell"},
      "Where a body feels the air and where its reaction goes, always with the same weights. 'cell' is the "
      "cell that contains the body's centre (Eq. 8); 'gaussian' has the width of the seed and converges "
      "under "
      "mesh refinement.");
  p.choice("Void fraction kernel", void_fraction_kernel, {"gaussian", "sampled", "none"},
           "How a seed's volume is taken from the air. 'sampled' counts sample points in cells (Eq. 5); "
           "'none' leaves "
           "the void fraction at 1.");
  p.number(
      "Kernel width", kernel_width, "m", Range::non_negative(),
      "Standard deviation of the Gaussian; 0 means one seed diameter. It should not be smaller than a cell.");
  p.integer("Samples per diameter", samples, Range::between(2, 100),
            "Sample points along a sub-sphere's diameter (Eq. 5).");
  p.choice("Solid volume", solid_volume, {"seed", "sub-spheres"},
           "The volume a seed takes from the air: that of the real seed, or the sum over its sub-spheres.");
  p.choice("Buoyancy volume", buoyancy_volume, {"seed", "sub-spheres", "none"},
           "The volume on which the pressure gradient (buoyancy included) and the added mass act.");
  p.choice(
      "Undisturbed velocity", undisturbed_velocity, {"oseen", "transient", "none"},
      "A drag law wants the air's velocity as if the seed were absent. 'oseen' removes the seed's own "
      "steady disturbance, computed for the Gaussian exchange kernel in closed form; 'transient' the one "
      "that the forces and the path of the seed so far have built up.");
  p.choice("Outside the mesh", outside, {"stop", "still air"},
           "Bodies outside the air's mesh. 'stop': the run stops. 'still air': they move through air at rest "
           "that nobody computes; they are counted, and what it does to them is booked apart.");
  p.flag("Two-way", two_way, "Whether the air feels the seeds.");
  p.number("Lowest void fraction", lowest_void_fraction, "1", Range::between(0.0, 0.99),
           "The run stops where the void fraction would fall below: seeds' volume is never cut off.");
}

void CouplingParameters::check(const Parameters& p) const {
  if (undisturbed_velocity != "none" && (exchange_kernel != "gaussian" || drag_on != "seed"))
    p.reject("Coupling/Undisturbed velocity",
             "the self-induced velocity is known for whole seeds with the Gaussian exchange kernel only",
             "set 'Undisturbed velocity = none', or 'Drag on = seed' with 'Exchange kernel = gaussian'");
}

}  // namespace seedflow
