#pragma once

#include <mpi.h>

#include <iosfwd>
#include <string>
#include <vector>

#include "seedflow/base/quaternion.h"
#include "seedflow/seeds/bonds.h"
#include "seedflow/seeds/contact_network.h"
#include "seedflow/seeds/contacts.h"
#include "seedflow/seeds/material.h"
#include "seedflow/seeds/motion.h"
#include "seedflow/seeds/seed_store.h"
#include "seedflow/seeds/time_step.h"
#include "seedflow/seeds/walls.h"

namespace seedflow {

class Parameters;

struct DemParameters {
  double time_step = 1e-6;    ///< largest substep [s]
  Vec3 gravity{0, 0, -9.81};  ///< [m/s2]
  BondParameters bonds;
  ContactParameters contacts;
  TimeStepParameters limits;

  void declare(Parameters& parameters);
};

/// What acts on the sub-spheres from outside, one entry per sub-sphere in the order of Dem::positions():
///   F = force + drag_coefficient (flow_velocity - v) - added_mass dv/dt
/// with the present v in every substep. Empty vectors mean zero.
struct SphereLoads {
  std::vector<Vec3> force;               ///< [N]
  std::vector<Vec3> torque;              ///< [N m]
  std::vector<double> drag_coefficient;  ///< [kg/s], any size >= 0
  std::vector<Vec3> flow_velocity;       ///< [m/s]
  std::vector<double> added_mass;        ///< [kg], >= 0
};

/// The motion of a whole seed.
struct SeedState {
  Vec3 centre;    ///< centre of mass [m]
  Vec3 velocity;  ///< of the centre of mass [m/s]
  Quaternion
      orientation;        ///< template frame to lab frame: exact if rigid, else the mean over the sub-spheres
  Vec3 spin;              ///< inertia^-1 angular momentum [rad/s]
  Vec3 angular_momentum;  ///< about the centre of mass [kg m2/s]
};

/// [J]
struct DemEnergies {
  double kinetic = 0;     ///< translation and rotation
  double bonds = 0;       ///< elastic, stored in bonds
  double potential = 0;   ///< -m g . x
  double dissipated = 0;  ///< by bond damping and breaking
};

/// Bonded and rigid seeds under gravity, bonds, contacts and outside loads, integrated by velocity Verlet.
///
/// Kick: m dv/dt = F + k (u - v) with F (bonds, contacts, gravity, explicit loads) held, solved exactly, so
/// any drag is stable and the impulse of the drag is known to the last bit: mass x change of velocity =
/// gravity + loads + fluid impulse + wall impulse. Drift: x += v dt, the orientation turned by exactly omega
/// dt; rigid seeds turn by the symplectic splitting of Dullweber, Leimkuhler & McLachlan (1997).
///
/// Sub-spheres are numbered seed by seed in the order in which seeds were added, whatever their template.
/// Contacts act between different seeds and with walls; sub-spheres of one seed know each other through bonds
/// only, so fragments of a broken seed pass through each other. Every MPI rank holds and computes all seeds;
/// the arithmetic does not depend on the number of ranks.
///
/// Errors: InputError from add_* and check(): a seed outside the domain or inside a wall, a time step above
/// its limit. RunError from advance(): NaN, or a seed's centre outside the domain: which seed, where, when.
class Dem {
 public:
  explicit Dem(const DemParameters& parameters = {}, MPI_Comm communicator = MPI_COMM_SELF);

  // Setting up.
  int add_material(const Material& material);
  /// Without this a pair of materials has the properties of ContactProperties' defaults.
  void set_contact(int material_a, int material_b, const ContactProperties& properties);
  int add_template(const SeedTemplate& model, int material, bool rigid);
  int add_wall(const Wall& wall);
  /// Six walls named x-, x+, ..., z+ around the box, and the box as domain.
  void add_box(const Vec3& low, const Vec3& high, int material);
  void set_wall_velocity(int wall, const Vec3& velocity);
  /// A wall that is not active touches nothing (a gate that has been taken away).
  void set_wall_active(int wall, bool active);
  /// Seeds' centres must stay inside.
  void set_domain(const Vec3& low, const Vec3& high);
  /// Returns the seed's index; also between two calls of advance(). The new seed shall touch nothing.
  int add_seed(int seed_template, const Vec3& centre, const Quaternion& orientation = {},
               const Vec3& velocity = {}, const Vec3& spin = {});
  /// Takes seeds out. Those behind move up: indices shift, labels stay. Outside loads are forgotten.
  void remove_seeds(const std::vector<int>& seeds);
  /// Throws InputError if a seed overlaps a wall or another seed, leaves the domain, or the time step is too
  /// large.
  void check();
  /// All limits of the time step for the seeds present.
  std::vector<TimeStepLimit> time_step_limits() const;

  // Running.
  /// Replaces the outside loads; they stay until replaced. Sizes are n_spheres() or 0.
  void set_loads(const SphereLoads& loads);
  /// Advances by `duration` [s] in equal substeps not longer than the time step.
  void advance(double duration);
  /// Impulse every sub-sphere received during the last advance() through drag and added mass,
  /// integral of k (u - v) - m_a dv/dt [N s]; the fluid receives the opposite.
  void fluid_impulses(std::vector<Vec3>& impulses) const;
  /// Impulse every wall gave to the seeds since the start [N s].
  const std::vector<Vec3>& wall_impulses() const { return wall_impulse; }

  // Looking.
  double time() const { return now; }
  long n_substeps() const { return substeps; }
  int n_seeds() const { return static_cast<int>(slots.size()); }
  int n_spheres() const { return first.empty() ? 0 : first.back(); }
  /// Sub-spheres first_sphere(i) ... first_sphere(i + 1) - 1 belong to seed i.
  int first_sphere(int seed) const { return first[seed]; }
  int seed_of_sphere(int sphere) const;
  /// Persistent identity: 0, 1, ... in the order of adding, never given again.
  long seed_label(int seed) const { return labels[seed]; }
  /// A mark of the user's (colour), 0 at first.
  int seed_group(int seed) const { return groups[seed]; }
  void set_group(int seed, int group) { groups[seed] = group; }
  const SeedTemplate& seed_template(int seed) const;
  bool is_rigid(int seed) const;
  void positions(std::vector<Vec3>& out) const;
  void velocities(std::vector<Vec3>& out) const;
  void angular_velocities(std::vector<Vec3>& out) const;
  const std::vector<double>& radii() const { return sphere_radius; }
  const std::vector<double>& masses() const { return sphere_mass; }
  SeedState seed_state(int seed) const;
  DemEnergies energies() const;
  Vec3 momentum() const;
  double max_speed() const;
  int n_broken_bonds() const;
  int n_broken_bonds(int seed) const;
  const std::vector<Wall>& walls() const { return all_walls; }
  Wall& wall(int w) { return all_walls.at(w); }
  const std::vector<Material>& materials() const { return material; }
  int n_contacts() const { return contacts.n_touching(); }
  /// All touching pairs after the last advance().
  ContactNetwork contact_network() const;
  /// Number of other seeds and walls that each seed touches.
  std::vector<int> coordination_numbers() const;
  std::size_t bytes() const;  ///< of all state and lists

  /// The complete state in binary; load() into a Dem set up in the same way, the same seeds added in the same
  /// order, continues to the last bit. RunError if the state is cut off or belongs to other seeds.
  void save(std::ostream& out) const;
  void load(std::istream& in);

 private:
  struct Slot {
    int store, slot;
  };
  SphereLanes& lanes_of(int seed, int sphere, int& lane);
  const SphereLanes& lanes_of(int seed, int sphere, int& lane) const;
  template <class Member>
  void gather(std::vector<Vec3>& out, Member member) const;
  void number_spheres();
  void refresh_addresses();
  void sum_contacts(double step);
  void sum_bonds(double step);
  /// Adds the forces of the bonds (unless bond_step is 0) and moves the seeds.
  void move(double bond_step, const MotionStep& motion);
  void begin_impulses(double step);
  void end_impulses(double duration);
  void check_state() const;
  void check_seed(const SeedStore& s, int slot, const Vec3& centre, const Vec3& velocity) const;
  void relax_factors(double step);

  DemParameters parameters;
  MPI_Comm communicator;
  std::vector<Material> material;
  std::vector<SeedStore> store;
  std::vector<Bonds> bonds;   ///< [template]
  std::vector<Slot> slots;    ///< [seed]
  std::vector<int> first{0};  ///< [seed] first sub-sphere
  std::vector<double> sphere_radius, sphere_mass;
  std::vector<long> labels;  ///< [seed], ascending
  std::vector<int> groups;   ///< [seed]
  long next_label = 0;
  std::vector<Wall> all_walls;
  std::vector<char> wall_active;
  std::vector<Vec3> wall_impulse;
  std::vector<Vec3> wall_force;        ///< on the seeds by each wall at the present positions [N]
  std::vector<SphereAddress> address;  ///< [sub-sphere]; empty after a change of the stores
  std::vector<ForceLanes> scratch;     ///< one block
  Contacts contacts;
  Vec3 low, high;
  bool bounded = false, loaded = false, forces_known = false;
  double now = 0;
  double load_step = 0;      ///< substep the relaxation factors were computed for [s]
  double largest_speed = 0;  ///< of any sub-sphere at the last kick [m/s]
  long substeps = 0;
};

}  // namespace seedflow
