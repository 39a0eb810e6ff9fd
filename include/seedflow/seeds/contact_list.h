#pragma once

#include <vector>

#include "seedflow/seeds/contact_history.h"
#include "seedflow/seeds/contact_law.h"
#include "seedflow/seeds/contact_sphere.h"
#include "seedflow/seeds/seed_search.h"

namespace seedflow {

/// The sub-spheres that stand in the contact lists of this rank, in the order of their numbers, and what
/// contacts do to their bodies. Bodies: every bonded sub-sphere is one, a rigid seed is one.
struct ContactBodies {
  std::vector<int> sphere;           ///< [entry] number of the sub-sphere
  std::vector<ContactSphere> state;  ///< [entry]
  std::vector<int> body;             ///< [entry] which sum
  std::vector<ContactSum> sum;       ///< [body]
};

/// Lines of memory for contacts that begin and end.
class ContactMemoryPool {
 public:
  int take() {
    if (free.empty()) return lines.emplace_back(), static_cast<int>(lines.size()) - 1;
    const int line = free.back();
    free.pop_back();
    return line;
  }
  void release(int line) { lines[line] = ContactLine{}, free.push_back(line); }
  void reserve(std::size_t n) { std::vector<ContactLine>().swap(lines), lines.reserve(n); }
  void clear() { lines.clear(), free.clear(); }
  ContactLine& operator[](int line) { return lines[line]; }
  const ContactLine& operator[](int line) const { return lines[line]; }
  std::size_t bytes() const { return lines.capacity() * sizeof(ContactLine) + free.capacity() * sizeof(int); }

 private:
  std::vector<ContactLine> lines;
  std::vector<int> free;
};

/// Pairs of sub-spheres with a gap below the skin, and their contacts.
///
/// Every substep lane_width pairs at once are tested; those that touch are taken together, lane_width at
/// once, by the law. Pairs are sorted by law, then by the numbers of their sub-spheres, and forces are added
/// to the bodies in this order: sums depend neither on lanes nor on which rank holds which other pairs.
class PairList {
 public:
  /// Takes over the pairs; those in `history` keep what they remember. `law` [pair], `entry_of` [sub-sphere].
  /// `group` [pair] numbers pairs of the same two seeds for the normalisation of multiple contacts, else
  /// empty.
  void set(const std::vector<SpherePair>& pairs, const std::vector<int>& law, const std::vector<int>& group,
           const std::vector<int>& entry_of, const std::vector<ContactLaw>& laws, const ContactBodies& bodies,
           const ContactHistory& history);
  void add_forces(const std::vector<ContactLaw>& laws, ContactBodies& bodies, double step);
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
  template <Rolling rolling, Cohesion cohesion>
  void add_segment(const Segment& segment, const ContactLaw& law, ContactBodies& bodies, double step);

  std::vector<Segment> segments;
  std::vector<int> first, second;   ///< [pair] entries; lane_width zeros behind
  std::vector<int> slot;            ///< [pair] line of memory, -1 when apart
  std::vector<unsigned char> near;  ///< [lane_width pairs of a segment] one bit each: slot is not -1
  std::vector<int> same_seeds;      ///< [pair] group
  std::vector<int> n_in_group;      ///< [group] touching pairs
  std::vector<int> touching;        ///< pairs, ascending; lane_width entries room behind
  ContactMemoryPool memory;
};

}  // namespace seedflow
