#pragma once

#include <vector>

#include "seedflow/seeds/contact_history.h"
#include "seedflow/seeds/contact_law.h"
#include "seedflow/seeds/contact_memory_pool.h"
#include "seedflow/seeds/contact_sphere.h"
#include "seedflow/seeds/seed_search.h"

namespace seedflow {

/// The sub-spheres that stand in the contact lists of this rank, in the order of their numbers, and their
/// bodies. Bodies: every bonded sub-sphere and every plain sphere is one (then entry and body are the same),
/// a rigid seed is one.
struct ContactBodies {
  std::vector<int> sphere;            ///< [entry] number of the sub-sphere
  std::vector<ContactSphere> state;   ///< [entry]
  std::vector<int> body;              ///< [entry]
  std::vector<ContactMotion> motion;  ///< [body]
  std::vector<HalfLine> centre;       ///< [body] about which it turns [m]; only with levers()
  std::vector<ContactSum> sum;        ///< [body]

  /// Bodies may turn about other points than the centres of their sub-spheres.
  bool levers() const { return !centre.empty(); }
  std::size_t bytes() const {
    return (sphere.capacity() + body.capacity()) * sizeof(int) +
           (state.capacity() + centre.capacity()) * sizeof(HalfLine) +
           (motion.capacity() + sum.capacity()) * sizeof(CacheLine);
  }
};

/// Pairs of sub-spheres with a gap below the skin, and their contacts.
///
/// Every substep lane_width pairs at once are tested; those that touch are taken together, twice lane_width
/// at once, by the law. Pairs are sorted by law, then by the numbers of their sub-spheres, and forces are
/// added to the bodies in this order: sums depend neither on lanes nor on which rank holds which other pairs.
class PairList {
 public:
  /// Takes over the pairs; those in `history` keep what they remember. `law` [pair], `entry_of` [sub-sphere].
  /// `group` [pair] numbers pairs of the same two seeds for the normalisation of multiple contacts, else
  /// empty.
  void set(const std::vector<SpherePair>& pairs, const std::vector<int>& law, const std::vector<int>& group,
           const std::vector<int>& entry_of, const std::vector<ContactLaw>& laws, const ContactBodies& bodies,
           const ContactHistory& history);
  void add_forces(const std::vector<ContactLaw>& laws, ContactBodies& bodies, const ContactTimes& times);
  void collect(const ContactBodies& bodies, std::vector<ContactHistory::Pair>& out) const;

  int n_listed() const { return static_cast<int>(slot.size()); }
  const std::vector<int>& first_entries() const { return first; }
  const std::vector<int>& second_entries() const { return second; }
  std::size_t bytes() const;

 private:
  struct Segment {
    int law, begin, end;
    double reach;         ///< gap up to which contacts of this law act [m]
    int first_group = 0;  ///< of `near`
    int touching_begin = 0, touching_end = 0;
  };
  void find_touching(Segment& segment, const ContactBodies& bodies);
  struct Touching {
    int first, second;  ///< entries
    int line, pair;
  };
  template <Rolling rolling, Cohesion cohesion, bool partial, bool levers>
  void add_segment(const Segment& segment, const ContactLaw& law, ContactBodies& bodies,
                   const ContactTimes& times);
  void act(const Segment& segment, const ContactLaw& law, ContactBodies& bodies, const ContactTimes& times);
  void add_in_pieces(const Segment& segment, const ContactLaw& law, ContactBodies& bodies,
                     const ContactTimes& times);

  std::vector<Segment> segments;
  std::vector<int> first, second;   ///< [pair] entries; lane_width zeros behind
  std::vector<int> slot;            ///< [pair] line of memory, -1 when apart
  std::vector<unsigned char> near;  ///< [lane_width pairs of a segment] one bit each: slot is not -1
  std::vector<int> same_seeds;      ///< [pair] group
  std::vector<int> n_in_group;      ///< [group] touching pairs
  std::vector<Touching> touching;   ///< ascending; all of them, or those of a piece of a segment
  ContactMemoryPool memory;
};

}  // namespace seedflow
