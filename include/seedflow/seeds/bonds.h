#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "seedflow/seeds/seed_store.h"

namespace seedflow {

class Parameters;
class SeedShare;

/// Memory that is needed after the present block: its spheres and, if it has its own, its forces.
struct NextBlock {
  const SphereLanes* spheres = nullptr;
  const ForceLanes* forces = nullptr;
};

/// Parallel bonds between the sub-spheres of a seed (Potyondy & Cundall 2004; the source paper's Eqs. 1-2,
/// Table 4).
struct BondParameters {
  double normal_stiffness = 1e8;  ///< k_n, per unit area [N/m3]
  double shear_stiffness = 5e7;   ///< k_t, per unit area [N/m3]
  double normal_strength = 1e20;  ///< critical tensile stress [Pa]; 1e20 and above: never breaks
  double shear_strength = 1e20;   ///< critical shear stress [Pa]; 1e20 and above: never breaks
  double damping_ratio = 0;       ///< fraction of critical damping of each bond's pair of sub-spheres [1]
  std::string form = "total";     ///< total | incremental (Eq. 1)
  std::string moments =
      "standard";  ///< standard: twist k_t J, bending k_n I | printed: twist k_n J, bending k_t J/2

  void declare(Parameters& parameters);
  bool can_break() const { return normal_strength < 1e20 || shear_strength < 1e20; }
};

/// The bonds of one template with their stiffnesses, and the state of the bonds of all its seeds.
///
/// Total form. With the half bond vectors a_i = R_i d0/2 and a_j = R_j d0/2 carried by the two sub-spheres,
/// the gap between the ends is g = x_j - x_i - e, e = a_i + a_j, and (w, v) is the relative rotation q_j
/// q_i^-1. The energy
///   U = 1/2 k_t A |g|^2 + 1/2 (k_n - k_t) A (g.e)^2 / L0^2
///     + 2 K_b |v|^2 + 2 (K_t - K_b) (v.n)^2,   n = 2 a_i / L0,
/// does not change when the seed moves or turns as a whole, so its derivatives conserve momentum and angular
/// momentum exactly and, without damping, the energy of the motion. (g.e)/L0 is the elongation, the rest of g
/// the shear displacement of the bond's mid-point with both rotations in it, 2 v the relative rotation vector
/// up to third order; the torque (L/2) n x F_t of the shear force comes out by itself. A = pi R_b^2, I = pi
/// R_b^4/4, J = 2 I, K_b = k_n I, K_t = k_t J. No square root, no division, nothing singular when a bond is
/// squashed.
///
/// Incremental form (Eq. 1): forces and moments are summed over the steps from relative velocities at the
/// bond's mid-point, along and across its present direction, and turned with it.
class Bonds {
 public:
  Bonds() = default;
  Bonds(const SeedTemplate& model, const BondParameters& parameters);

  int n_bonds() const { return static_cast<int>(constants.size()); }
  void add_block();
  /// As SeedStore::rearrange(): slot k holds from now on the bonds of slot from[k].
  void rearrange(const std::vector<int>& from);

  /// Adds the forces and torques of all bonds of block b of the spheres to `forces`. `step` [s] is the time
  /// since the last call (incremental form, damping). What comes `next` is called into the cache meanwhile.
  void add_forces(const SphereLanes* spheres, ForceLanes* forces, int b, double step,
                  const NextBlock& next = {});

  /// Elastic energy of each lane [J].
  Lanes energy(const SphereLanes* spheres, int b) const;
  /// Energy taken out by bond damping and by breaking, all blocks, occupied lanes [J].
  double dissipated_energy() const;
  /// Broken bonds of the seed in this lane.
  int n_broken(int b, int lane) const;
  bool is_broken(int b, int bond, int lane) const;

  /// Largest angular frequency of the undamped bonded seed [rad/s]; velocity Verlet is stable up to
  /// 2/omega_max.
  double largest_frequency(const SeedTemplate& model) const;

  /// Brings what other ranks know of their blocks of store t.
  void gather(const SeedShare& share, int t);

  std::size_t bytes() const;
  void save(std::ostream& out) const;
  void load(std::istream& in);

 private:
  /// Constants of one bond of the template.
  struct Constants {
    int first, second;
    double half[3];                ///< d0/2 [m]
    double shear;                  ///< k_t A [N/m]
    double normal;                 ///< k_n A [N/m]
    double stretch;                ///< (k_n - k_t) A / L0^2 [N/m3]
    double bend;                   ///< K_b [N m]
    double twist;                  ///< K_t [N m]
    double twist_extra;            ///< (K_t - K_b) 4 / L0^2 [N/m]
    double length;                 ///< L0 [m]
    double damping[2];             ///< of the gap [N s/m], of the relative rotation [N m s]
    double area, radius, inertia;  ///< A [m2], R_b [m], I [m4]
  };
  /// What the incremental form remembers of one bond, lab frame.
  struct History {
    LaneVec3 direction;  ///< unit vector when the forces were last turned
    LaneVec3 shear;      ///< shear force on the second sub-sphere [N]
    LaneVec3 bend;       ///< bending moment on the second sub-sphere [N m]
    Lanes normal = {};   ///< tensile force [N]
    Lanes twist = {};    ///< twisting moment on the second sub-sphere along the direction [N m]
  };

  template <bool breaking, bool damping>
  void add_total(const SphereLanes* spheres, ForceLanes* forces, int b, double step, const NextBlock& next);
  void add_incremental(const SphereLanes* spheres, ForceLanes* forces, int b, double step);

  BondParameters parameters;
  std::vector<Constants> constants;  ///< sorted by first
  std::vector<Lanes> intact;         ///< [block][bond] 1 or 0; empty when bonds cannot break
  std::vector<History> history;      ///< [block][bond]; incremental form only
  int n_spheres = 0;
  std::vector<double> dissipated;  ///< [block]
  double dissipated_before = 0;    ///< until the last rearrange()
};

}  // namespace seedflow
