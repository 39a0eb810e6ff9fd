#pragma once

#include <vector>

#include "seedflow/seeds/contact_list.h"
#include "seedflow/seeds/neighbour_skin.h"
#include "seedflow/seeds/wall_list.h"

namespace seedflow {

class Parameters;

struct ContactParameters {
  double skin =
      0;  ///< lists hold pairs with gaps below the skin [m]; 0: chosen while running, see NeighbourSkin
  bool normalise = false;  ///< n contacts between the same two seeds act as one

  void declare(Parameters& parameters);
};

/// Contacts between sub-spheres of different seeds and between sub-spheres and walls, of the seeds of this
/// rank (of a pair across ranks both sides are computed by both).
///
/// The lists hold what comes closer than the skin. They are a matter of speed alone: forces depend on what
/// touches, and are summed in the order of the sub-spheres' numbers, so neither skin nor the instants of the
/// searches nor the number of ranks changes a single bit of the motion.
class Contacts {
 public:
  /// Law of a pair of materials; both orders.
  void set_law(int material_a, int material_b, const ContactLaw& law);
  const ContactLaw& law(int material_a, int material_b) const {
    return laws[law_number[material_a][material_b]];
  }

  /// Where an entry stands in its store.
  struct Place {
    int sphere, lane;  ///< sub-sphere of the template, lane of the block
  };
  /// What belongs to one search.
  struct Surroundings {
    const std::vector<SeedStore>& stores;
    SeedCloud& cloud;
    const std::vector<char>& own;         ///< [seed, see Numbering]
    const std::vector<int>& first_block;  ///< [store] blocks numbered through
    const std::vector<Wall>& walls;
    const std::vector<Placement>& placements;
  };
  /// Makes the lists of pairs with gaps below the skin anew; contacts in `history` keep what they remember.
  /// All entries are to be placed. Returns what this rank listed.
  ListSizes search(const Surroundings& now, double skin, bool normalise, const ContactHistory& history);
  bool is_listed() const { return listed_skin > 0; }
  void forget() { listed_skin = 0, on_walls.forget_fault(); }
  double skin() const { return listed_skin; }

  // Between the stores' blocks (numbered through) and the entries.
  /// Hands the sums of a block's bodies over and sets them to zero.
  void take_forces(int block, ForceLanes* forces);    ///< bonded: added, per sub-sphere
  void take_forces(int block, ForceLanes& on_seeds);  ///< rigid: added, per seed
  /// Takes the state of a block's sub-spheres that stand in the lists.
  void place(int block, const SeedStore& store, int b);

  /// Entries of a block (numbered through): [entries(b), entries(b + 1)).
  int entries(int block) const { return first_entry[block]; }
  const Place& place(int entry) const { return places[entry]; }
  ContactBodies& bodies() { return all_bodies; }
  const ContactBodies& bodies() const { return all_bodies; }
  const PairList& pair_list() const { return pairs; }

  /// Adds the forces of all contacts to the sums of the bodies.
  void add_forces(const std::vector<Wall>& walls, const std::vector<Placement>& placements,
                  const ContactTimes& times) {
    pairs.add_forces(laws, all_bodies, times);
    on_walls.add_forces(laws, walls, placements, all_bodies, times);
  }
  void add_wall_forces(double factor, int n_walls, std::vector<Vec3>& sum) const {
    on_walls.add_wall_forces(factor, n_walls, sum);
  }
  const WallFault& fault() const { return on_walls.fault(); }

  /// What all listed contacts remember, sorted.
  ContactHistory history() const;
  std::size_t bytes() const;

 private:
  /// Numbers the entries that are marked with 0.
  void make_entries(const Surroundings& now, std::vector<int>& entry_of);
  void list_pairs(const Surroundings& now, bool normalise, const ContactHistory& history,
                  const FoundPairs& found, const std::vector<int>& entry_of);
  void list_walls(const Surroundings& now, bool normalise, const ContactHistory& history,
                  const std::vector<WallCandidate>& found, const std::vector<int>& entry_of);
  void place_bonded(int block, const SeedStore& store, int b);
  void place_rigid(int block, const SeedStore& store, int b);
  void place_plain_spheres(int block, const SeedStore& store, int b);

  std::vector<std::vector<int>> law_number;  ///< [material][material]
  std::vector<ContactLaw> laws;
  ContactBodies all_bodies;
  std::vector<Place> places;     ///< [entry]
  std::vector<int> first_entry;  ///< [block]
  PairList pairs;
  WallList on_walls;
  double listed_skin = 0;  ///< the lists were made with [m]; 0: no lists
};

}  // namespace seedflow
