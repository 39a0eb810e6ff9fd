#pragma once

#include <map>
#include <string>
#include <vector>

#include "seedflow/truth/truth_flow.h"

namespace seedflow {

/// A plane wall: a point on it and the unit normal into the fluid.
struct TruthWall {
  Vec3 point, normal;
};

/// A seed, its fluid and what acts on it, for making data in which an effect is hidden. Written apart from
/// the model: it shares no force code with it, uses other published forms wherever there are any, and solves
/// with another integrator. SI units.
///
/// Names of effects are those of the catalogue; an amplitude of 1 is the published effect, 0 or no entry:
/// absent. Forms (the model's default in brackets):
///  Drag               C_D = 24/Re (1 + 0.150 Re^0.681) + 0.407/(1 + 8710/Re), Brown & Lawler (2003),
///                     doi:10.1061/(ASCE)0733-9372(2003)129:3(222) [Schiller-Naumann]
///  Nonspherical drag  the same law, coded apart: published forms of it differ by 20 to 40 %
///                     at Re 20 (Hoelzer & Sommerfeld 2008, Chien 1994), more than the drag is known
///                     [Haider-Levenspiel]
///  Hindered settling  Wen & Yu (1966): f(eps Re)/f(Re) eps^-2.65 [Di Felice]
///  Tube wall drag     Haberman & Sayre (1958), Stokes flow [Di Felice]
///  Plane wall drag    towards it Bevan & Prieve (2000), doi:10.1063/1.481900; along it Perkins & Jones
///                     (1992), Physica A 189, 447-477 [Brenner's series; Faxen with lubrication]
///  Pressure gradient  rho V (Du/Dt - g): exact
///  Added mass         rho V/2 (Du/Dt - dv/dt): exact
///  History force      kernel of Mei & Adrian (1992), integrated directly over the whole past
///                     [Dorgan & Loth, thinned past]
///  Saffman lift       McLaughlin (1991), his J in the fit (1 + 0.2/e^2)^-3/2 of Legendre & Magnaudet (1998),
///                     doi:10.1017/S0022112098001621 [Mei]
///  Magnus lift        Loth (2008), doi:10.2514/1.29159 [Oesterle & Bui Dinh]
///  Wall lift          Cherukat & McLaughlin (1994) [Takemura & Magnaudet]
///  Rotational drag    Stokes flow: exact for small Re [Rubinow & Keller; Dennis et al.]
///  Faxen force        k d^2/24 laplace u: exact in Stokes flow
struct TruthSeed {
  double diameter = 4e-3, density = 1340, sphericity = 1;  ///< of the seed
  double fluid_density = 1000, viscosity = 1e-3, void_fraction = 1;
  double tube_diameter = 0;  ///< 0: none
  double drag_level = 1;     ///< factor on the drag: what no correlation knows better than 4 %
  Vec3 gravity{0, 0, -9.81};
  TruthFlow flow;
  std::vector<TruthWall> walls;
  Vec3 position, velocity, spin;  ///< at t = 0
  std::map<std::string, double> amplitudes;

  /// Forces outside the catalogue; amplitude 0: none.
  struct Unknown {
    Vec3 uniform;  ///< force per mass [m/s2]
    /// Drag times (1 + amplitude)(Re/reference)^exponent.
    double drag_amplitude = 0, drag_exponent = 0, drag_reference = 1;
    /// Lift amplitude 3 pi mu d |w| (Re_s)^exponent along w x curl u, Re_s = rho d^2 |curl u|/mu.
    double shear_amplitude = 0, shear_exponent = 0;
    /// -amplitude m x along e_x [1/s2]: a trap
    double trap = 0;
  } unknown;

  double amplitude(const std::string& effect) const;
  double mass() const;
  double volume() const;
};

struct TruthState {
  Vec3 position, velocity, spin;
};

/// States at rising times [s]. Without memory: Dormand & Prince's pair of orders 5 and 4, steps controlled to
/// `tolerance` relative to the size of position (a diameter), velocity and spin. With the history force:
/// trapezoidal rule with `history_steps` equal steps, the integral over the whole past by product
/// integration. Errors: RunError if the step size collapses or the state stops being finite; InputError for
/// an unknown name of an effect.
std::vector<TruthState> truth_states(const TruthSeed& seed, const std::vector<double>& times,
                                     double tolerance = 1e-9, int history_steps = 600);

/// Names this generator knows.
const std::vector<std::string>& truth_effects();

}  // namespace seedflow
