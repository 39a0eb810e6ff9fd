#pragma once

#include <mpi.h>

#include <iosfwd>
#include <string>
#include <vector>

#include "seedflow/base/quaternion.h"
#include "seedflow/seeds/bonds.h"
#include "seedflow/seeds/contact_network.h"
#include "seedflow/seeds/contacts.h"
#include "seedflow/seeds/late_maximum.h"
#include "seedflow/seeds/material.h"
#include "seedflow/seeds/motion.h"
#include "seedflow/seeds/seed_share.h"
#include "seedflow/seeds/seed_store.h"
#include "seedflow/seeds/time_step.h"
#include "seedflow/seeds/travel.h"
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
/// only, so fragments of a broken seed pass through each other.
///
/// In memory the seeds stand along a space-filling curve, and the ranks of the communicator compute
/// contiguous parts of it. Between calls every rank remembers everything, and calls are collective. Neither
/// the number of ranks nor the instants of the neighbour searches change a bit of the result.
///
/// Errors: InputError from add_* and check(): a seed outside the domain or inside a wall, a time step above
/// its limit. RunError from advance(): NaN, a seed's centre outside the domain, a sub-sphere's centre behind
/// a wall: which seed, where, when.
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
  /// The largest substep from now on [s].
  void set_time_step(double time_step) { parameters.time_step = time_step; }
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
  /// Sum of the forces of all contacts on a seed at the end of the last advance() [N]; zero before the first.
  Vec3 contact_force(int seed) const;
  DemEnergies energies() const;
  Vec3 momentum() const;
  double max_speed() const;
  int n_broken_bonds() const;
  int n_broken_bonds(int seed) const;
  const std::vector<Wall>& walls() const { return all_walls; }
  /// To change a wall between two calls of advance().
  Wall& wall(int w);
  const std::vector<Material>& materials() const { return material; }
  int n_contacts() const;
  long n_searches() const { return searches; }
  /// Cost of the busiest rank over the mean, by the numbers of sub-spheres and contacts.
  double imbalance() const { return share.imbalance(); }
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
  struct OwnBlock {
    int store, block;
  };
  enum class Stage { first, middle, last };  ///< of the substeps of advance()

  template <class F>
  void for_each_seed(const F& f) const;

  void check_overlaps() const;
  // dem.cc
  void evaluate_forces(double step);
  void contact_forces(double time, double step);
  bool lists_are_outdated(double time, double step);
  void move(Stage stage, const MotionStep& motion, double bond_step);
  void move_block(Stage stage, const MotionStep& motion, double bond_step, std::size_t k);
  void learn_speed(double step);
  // dem_loads.cc
  void relax_factors(double step);
  void begin_impulses(double step);
  void end_impulses(double duration);
  // dem_lists.cc: contact lists
  void make_lists(double time);
  std::vector<Placement> placements(double time) const;
  double wall_speed(double time) const;
  std::vector<int> sphere_numbers() const;
  void order_blocks();
  ContactHistory history() const;
  void park();
  // dem_order.cc: order in memory, ranks
  void number();
  void arrange();
  void divide();
  std::vector<Vec3> centres() const;
  bool arrangement_is_due() const;
  void complete(double time, bool with_forces);
  void complete_positions();
  void check_walls(double time) const;
  void check_state(double time) const;
  std::string place_of(int seed) const;

  DemParameters parameters;
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
  std::vector<Vec3> wall_impulse;
  std::vector<Vec3> wall_force;     ///< on the seeds by each wall at the end of advance() [N]
  std::vector<Vec3> block_impulse;  ///< [block * n_walls + wall] since advance() began [N s]
  std::vector<ForceLanes> scratch;  ///< one block
  Contacts contacts;
  Travel travel;
  NeighbourSkin skin;
  ContactHistory parked;  ///< while there are no lists; by the user's numbers of sub-spheres
  ContactHistory merged;  ///< of all ranks, at the end of advance(); by numbers in memory
  SeedShare share;
  GhostExchange ghosts;
  Numbering numbering;
  std::vector<int> first_block;      ///< [store] blocks numbered through
  std::vector<OwnBlock> own_blocks;  ///< in the order in which they are moved
  std::size_t n_awaited = 0;         ///< of these, which come first: other ranks wait for them
  Vec3 low, high;
  Vec3 lowest, highest;  ///< box around all seeds when the lists were made
  bool bounded = false, forces_known = false, divided = false;
  double now = 0;
  double load_step = 0;      ///< substep the relaxation factors were computed for [s]
  double largest_speed = 0;  ///< of any sub-sphere at the last kick that is known of all ranks [m/s]
  LateMaximum speed;         ///< of any sub-sphere at the last kick [m/s]
  FastestSpeeds fastest;     ///< of this rank's seeds
  long substeps = 0, searches = 0;
  long searched_at = 0;   ///< substep of the last search
  long arranged_at = -1;  ///< substep of the last sorting; -1: not sorted
  int arranged_seeds = 0;
  long seeds_at_start = -1;  ///< seeds added before the first advance(); -1: not begun
};

}  // namespace seedflow
