#include "seedflow/seeds/contact_list.h"

#include <algorithm>

#include "seedflow/seeds/contact_geometry.h"

namespace seedflow {

void PairList::set(const std::vector<SpherePair>& pairs, const std::vector<int>& law,
                   const std::vector<int>& group, const std::vector<int>& entry_of,
                   const std::vector<ContactLaw>& laws, const ContactBodies& bodies,
                   const ContactHistory& history) {
  segments.clear(), first.clear(), second.clear(), slot.clear(), same_seeds.clear(), near.clear();
  memory.clear();
  memory.reserve(history.pairs.size() + history.pairs.size() / 8);
  const std::size_t room = pairs.size() + lane_width;
  for (std::vector<int>* list : {&first, &second, &slot, &touching}) {
    std::vector<int>().swap(*list);
    list->reserve(room);
  }
  for (int l = 0; l < static_cast<int>(laws.size()); ++l) {
    Segment segment{l, static_cast<int>(first.size()), 0, 0};
    auto old = history.pairs.begin();
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      if (law[k] != l) continue;
      const SpherePair& pair = pairs[k];
      first.push_back(entry_of[pair.first]);
      second.push_back(entry_of[pair.second]);
      slot.push_back(-1);
      if (!group.empty()) same_seeds.push_back(group[k]);
      const double a = bodies.state[first.back()].radius(), b = bodies.state[second.back()].radius();
      segment.reach = std::max(segment.reach, laws[l].reach(a * b / (a + b)));
      while (old != history.pairs.end() &&
             (old->first != pair.first ? old->first < pair.first : old->second < pair.second))
        ++old;
      if (old != history.pairs.end() && old->first == pair.first && old->second == pair.second) {
        slot.back() = memory.take();
        std::copy_n(old->memory, 8, memory[slot.back()].value);
      }
    }
    segment.end = static_cast<int>(first.size());
    segment.first_group = static_cast<int>(near.size());
    for (int k = segment.begin; k < segment.end; k += lane_width) {
      unsigned bits = 0;
      for (int l = 0; l < lane_width && k + l < segment.end; ++l) bits |= (slot[k + l] >= 0) << l;
      near.push_back(static_cast<unsigned char>(bits));
    }
    if (segment.end > segment.begin) segments.push_back(segment);
  }
  first.resize(slot.size() + lane_width, 0);
  second.resize(slot.size() + lane_width, 0);
  n_in_group.assign(group.empty() ? 0 : *std::max_element(group.begin(), group.end()) + 1, 0);
  touching.assign(slot.size() + lane_width, 0);
}

void PairList::find_touching(Segment& segment, const ContactBodies& bodies) {
  static_assert(sizeof(ContactSphere) == 2 * sizeof(CacheLine));
  const CacheLine* const records = &bodies.state.front().motion;
  int* const list = touching.data();
  int end = segment.touching_begin;
  for (int k = segment.begin, g = segment.first_group; k < segment.end; k += lane_width, ++g) {
    const int *const a = &first[k], *const b = &second[k];
    // First sub-spheres follow each other in memory, second ones do not.
    if (k + 4 * lane_width <= n_listed())
      for (int l = 3 * lane_width; l < 4 * lane_width; ++l) __builtin_prefetch(records + 2 * b[l]);
    const CacheLine *of_a[lane_width], *of_b[lane_width];
    for (int l = 0; l < lane_width; ++l) of_a[l] = records + 2 * a[l], of_b[l] = records + 2 * b[l];
    Lanes d[4];
    load_differences(of_a, of_b, d);
    const Lanes close = d[3] + segment.reach;
    unsigned bits = mask_bits(d[0] * d[0] + d[1] * d[1] + d[2] * d[2] < close * close);
    if (k + lane_width > segment.end) bits &= (1u << (segment.end - k)) - 1;
    for (unsigned changed = bits ^ near[g]; changed; changed &= changed - 1) {
      const int l = __builtin_ctz(changed);
      int& line = slot[k + l];
      if (bits >> l & 1)
        line = memory.take();
      else
        memory.release(line), line = -1;
    }
    near[g] = static_cast<unsigned char>(bits);
    for (; bits; bits &= bits - 1) list[end++] = k + __builtin_ctz(bits);
  }
  segment.touching_end = end;
}

template <Rolling rolling, Cohesion cohesion>
void PairList::add_segment(const Segment& segment, const ContactLaw& law, ContactBodies& bodies,
                           double step) {
  const bool normalised = !same_seeds.empty();
  for (int k = segment.touching_begin; k < segment.touching_end; k += lane_width) {
    const int n = std::min(lane_width, segment.touching_end - k);
    for (int next = k + lane_width; next < std::min(k + 2 * lane_width, segment.touching_end); ++next) {
      const int a = first[touching[next]], b = second[touching[next]];
      __builtin_prefetch(&bodies.state[a].turning);
      __builtin_prefetch(&bodies.state[b].turning);
      __builtin_prefetch(&bodies.sum[bodies.body[a]], 1);
      __builtin_prefetch(&bodies.sum[bodies.body[b]], 1);
      __builtin_prefetch(&memory[slot[touching[next]]], 1);
    }
    int pair[lane_width];
    const CacheLine *motion_a[lane_width], *turning_a[lane_width], *motion_b[lane_width],
        *turning_b[lane_width], *line[lane_width];
    Lanes share = Lanes{} + 1.0;
    for (int l = 0; l < lane_width; ++l) {
      pair[l] = touching[k + std::min(l, n - 1)];
      const ContactSphere &a = bodies.state[first[pair[l]]], &b = bodies.state[second[pair[l]]];
      motion_a[l] = &a.motion, turning_a[l] = &a.turning;
      motion_b[l] = &b.motion, turning_b[l] = &b.turning;
      line[l] = &memory[slot[pair[l]]];
      if (normalised) share[l] = contact_share(n_in_group[same_seeds[pair[l]]]);
    }
    const LaneSphere a(motion_a, turning_a), b(motion_b, turning_b);
    LaneMemory remembered(line);
    const PairAction action = act_between<rolling, cohesion>(law, a, b, share, step, remembered.memory);
    CacheLine on_a[lane_width], on_b[lane_width], kept[lane_width];
    records_of(action.force, action.torque_a, on_a);
    records_of(-action.force, action.torque_b, on_b);
    remembered.to(action.normal_force, kept);
    for (int l = 0; l < n; ++l) {
      const_cast<CacheLine&>(*line[l]) = kept[l];
      add(bodies.sum[bodies.body[first[pair[l]]]], on_a[l]);
      add(bodies.sum[bodies.body[second[pair[l]]]], on_b[l]);
    }
  }
}

void PairList::add_forces(const std::vector<ContactLaw>& laws, ContactBodies& bodies, double step) {
  const auto act = [&](const Segment& segment) {
    with_models(laws[segment.law], [&](auto rolling, auto cohesion) {
      add_segment<decltype(rolling)::value, decltype(cohesion)::value>(segment, laws[segment.law], bodies,
                                                                       step);
    });
  };
  if (same_seeds.empty()) {
    // Tested and acted upon in pieces, so that the bodies are still in the cache.
    constexpr int piece = 32 * lane_width;
    for (const Segment& segment : segments)
      for (int begin = segment.begin; begin < segment.end; begin += piece) {
        Segment part = segment;
        part.begin = begin, part.end = std::min(begin + piece, segment.end);
        part.first_group += (begin - segment.begin) / lane_width;
        part.touching_begin = 0;
        find_touching(part, bodies);
        act(part);
      }
    return;
  }
  int begin = 0;
  for (Segment& segment : segments) {
    segment.touching_begin = begin;
    find_touching(segment, bodies);
    begin = segment.touching_end;
  }
  std::fill(n_in_group.begin(), n_in_group.end(), 0);
  for (int k = 0; k < begin; ++k) ++n_in_group[same_seeds[touching[k]]];
  for (const Segment& segment : segments) act(segment);
}

void PairList::collect(const ContactBodies& bodies, std::vector<ContactHistory::Pair>& out) const {
  for (std::size_t k = 0; k < slot.size(); ++k) {
    if (slot[k] < 0) continue;
    ContactHistory::Pair pair{bodies.sphere[first[k]], bodies.sphere[second[k]], {}};
    std::copy_n(memory[slot[k]].value, 8, pair.memory);
    out.push_back(pair);
  }
}

std::size_t PairList::bytes() const {
  return memory.bytes() + sizeof(int) * (first.capacity() + second.capacity() + slot.capacity() +
                                         same_seeds.capacity() + n_in_group.capacity() + touching.capacity());
}

}  // namespace seedflow
