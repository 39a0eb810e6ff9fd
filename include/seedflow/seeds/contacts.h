#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "seedflow/seeds/contact_law.h"
#include "seedflow/seeds/seed_store.h"
#include "seedflow/seeds/walls.h"

namespace seedflow {

class Parameters;

struct ContactParameters {
  double skin =
      0;  ///< lists hold pairs with gaps below the skin [m]; 0: a quarter of the smallest sub-sphere's radius

  void declare(Parameters& parameters);
};

/// Where one sub-sphere stands, and what its contacts need to know about it.
struct SphereAddress {
  const SphereLanes* lanes = nullptr;
  ForceLanes* force = nullptr;
  char* in_contact = nullptr;       ///< of its block
  const BodyLanes* body = nullptr;  ///< of a rigid seed, else none
  int lane = 0, seed = 0, material = 0;
  double radius = 0;   ///< [m]
  double mass = 0;     ///< m in m*: the seed's if rigid, else the sub-sphere's [kg]
  double inertia = 0;  ///< least moment of inertia of the body it belongs to [kg m2]
};

/// Contacts between sub-spheres of different seeds and between sub-spheres and plane walls.
///
/// Lists: seeds whose bounding spheres come closer than the skin (linked cells of the size of a seed), and of
/// these the pairs of sub-spheres with a gap below the skin. The lists stay valid until twice the longest way
/// any sub-sphere can have gone (sum of largest speed x step) reaches the skin. Every pair keeps its
/// tangential spring when lists are made anew; pairs are sorted by their sub-sphere numbers, so the sums do
/// not depend on the search.
///
/// Rolling friction is a torque of constant size mu_r F_n R against the rotation (against the relative
/// rotation of two sub-spheres), limited to what stops it within the step. R is the distance from the centre
/// of mass (of the seed if rigid, else of the sub-sphere) to the contact.
class Contacts {
 public:
  /// One pair with a gap below the skin; `second` is a sub-sphere or, in the list of walls, a wall.
  struct Pair {
    int first, second;
    Vec3 spring;  ///< tangential displacement [m]; zero when apart
    bool touching = false;
    double normal_force = 0;  ///< repulsion at the last substep [N]
  };

  void set_law(int material_a, int material_b, const ContactLaw& law);
  const ContactLaw& law(int material_a, int material_b) const { return laws[material_a][material_b]; }

  /// Makes the lists anew from present positions. `first` [seed] numbers the sub-spheres.
  void search(const std::vector<SphereAddress>& spheres, const std::vector<int>& first,
              const std::vector<Wall>& walls, const std::vector<char>& wall_active,
              const ContactParameters& parameters);
  /// Adds `distance` [m] to what any sub-sphere may have moved; true when the lists are to be made anew.
  bool moved(double distance) { return 2 * (travelled += distance) >= reach; }
  bool is_listed() const { return reach > 0; }
  void forget() { reach = 0; }

  /// Adds the forces of all contacts; wall_force [wall] receives the sum of the forces on the seeds by each
  /// wall [N].
  void add_forces(const std::vector<SphereAddress>& spheres, const std::vector<Wall>& walls, double step,
                  std::vector<Vec3>& wall_force);

  int n_touching() const;
  const std::vector<Pair>& sphere_pairs() const { return pairs; }
  const std::vector<Pair>& walls_pairs() const { return wall_pairs; }
  /// Sub-sphere i is called new_number[i] from now on; pairs of those with -1 are dropped.
  void renumber(const std::vector<int>& new_number);
  /// Largest overlap of a sub-sphere with a wall or with another seed among the listed pairs.
  double largest_overlap(const std::vector<SphereAddress>& spheres, const std::vector<Wall>& walls,
                         Pair& where, bool& is_wall) const;

  std::size_t bytes() const { return (pairs.capacity() + wall_pairs.capacity()) * sizeof(Pair); }
  void save(std::ostream& out) const;
  void load(std::istream& in);

 private:
  std::vector<std::vector<ContactLaw>> laws;  ///< [material][material]
  std::vector<Pair> pairs, wall_pairs;
  double reach = 0;      ///< skin the lists were made with [m]; 0: no lists
  double travelled = 0;  ///< since the lists were made [m]
};

}  // namespace seedflow
