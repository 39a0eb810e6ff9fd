#pragma once

#include <vector>

#include "seedflow/seeds/contact_list.h"
#include "seedflow/seeds/walls.h"

namespace seedflow {

/// A sub-sphere that may touch a wall.
struct WallCandidate {
  int sphere, wall;
};

/// A sub-sphere whose centre is behind a wall, or has come to the other side of a thin one.
struct WallFault {
  int sphere = -1, wall = -1;
};

/// Sub-spheres near walls and their contacts. One sphere may touch several features of a wall (faces, edges);
/// each keeps its own memory. Where a contact ends in the substep in which one with nearly the same normal
/// begins, the sphere has passed from one feature to its neighbour (from an edge to a face, from facet to
/// facet) and the new contact inherits the memory: friction does not notice how a surface is divided. Order
/// and arithmetic as in PairList.
class WallList {
 public:
  /// `candidates` sorted by sphere, wall; `law` and `group` (pairs of the same seed and wall) [candidate];
  /// `block` [candidate] is where the force on the wall is booked.
  void set(const std::vector<WallCandidate>& candidates, const std::vector<int>& law,
           const std::vector<int>& group, const std::vector<int>& block, const std::vector<int>& entry_of,
           const std::vector<ContactLaw>& laws, const ContactBodies& bodies, const ContactHistory& history);
  void add_forces(const std::vector<ContactLaw>& laws, const std::vector<Wall>& walls,
                  const std::vector<Placement>& place, ContactBodies& bodies, const ContactTimes& times);
  void collect(const ContactBodies& bodies, std::vector<ContactHistory::OnWall>& out) const;

  /// Adds factor x the force on the seeds of each block by each wall to sum[block * n_walls + wall].
  void add_wall_forces(double factor, int n_walls, std::vector<Vec3>& sum) const;
  /// The first sub-sphere found behind a wall since forget_fault(), or -1. New lists do not forget it.
  const WallFault& fault() const { return first_fault; }
  void forget_fault() { first_fault = {}; }
  std::size_t bytes() const;

 private:
  struct Candidate {
    int entry, wall, group, seat;
  };
  struct Segment {
    int law, begin, end;
    double reach;
    int touching_begin = 0, touching_end = 0;
  };
  struct Touching {
    int candidate, feature, line;
  };
  int inherited_line(std::vector<Touching>::iterator old, std::vector<Touching>::iterator last, int present);

  struct Seat {
    int block, wall;
    Vec3 force;
  };
  void find_touching(Segment& segment, const std::vector<Wall>& walls, const std::vector<Placement>& place,
                     const ContactBodies& bodies);
  template <Rolling rolling, Cohesion cohesion, bool partial, bool levers>
  void add_segment(const Segment& segment, const ContactLaw& law, ContactBodies& bodies,
                   const ContactTimes& times);

  std::vector<Segment> segments;
  std::vector<Candidate> candidate;
  std::vector<Touching> touching, before;      ///< sorted by candidate; features in the order they were found
  std::vector<CacheLine> point, point_before;  ///< [touching] normal, distance, velocity of the wall
  std::vector<int> n_in_group;
  std::vector<Seat> seat;
  std::vector<WallPoint> found;
  ContactMemoryPool memory;
  WallFault first_fault;
};

}  // namespace seedflow
