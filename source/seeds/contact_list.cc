#include "seedflow/seeds/contact_list.h"

#include <algorithm>

#include "seedflow/seeds/contact_geometry.h"

namespace seedflow {
namespace {

constexpr int width = width_of<LanePair>;  // contacts acted upon at once
constexpr int piece = 32 * lane_width;     // pairs tested one after the other

}  // namespace

void PairList::set(const std::vector<SpherePair>& pairs, const std::vector<int>& law,
                   const std::vector<int>& group, const std::vector<int>& entry_of,
                   const std::vector<ContactLaw>& laws, const ContactBodies& bodies,
                   const ContactHistory& history) {
  segments.clear(), same_seeds.clear(), near.clear();
  const auto more = [](const ContactLaw& l) { return l.remembers_more(); };
  memory.reset(std::any_of(laws.begin(), laws.end(), more), history.pairs.size());
  const std::size_t room = pairs.size() + lane_width;
  for (std::vector<int>* list : {&first, &second, &slot}) {
    if (list->capacity() > room + room / 4) std::vector<int>().swap(*list);
    list->clear(), list->reserve(room);
  }
  for (int l = 0; l < static_cast<int>(laws.size()); ++l) {
    Segment segment{l, static_cast<int>(first.size()), 0, 0};
    auto old = history.pairs.begin();
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      if (!law.empty() && law[k] != l) continue;
      const SpherePair& pair = pairs[k];
      first.push_back(entry_of[pair.first]);
      second.push_back(entry_of[pair.second]);
      slot.push_back(-1);
      if (!group.empty()) same_seeds.push_back(group[k]);
      if (laws[l].cohesion != Cohesion::none) {
        const double a = radius_of(bodies.state[first.back()]), b = radius_of(bodies.state[second.back()]);
        segment.reach = std::max(segment.reach, laws[l].reach(a * b / (a + b)));
      }
      while (old != history.pairs.end() &&
             (old->first != pair.first ? old->first < pair.first : old->second < pair.second))
        ++old;
      if (old != history.pairs.end() && old->first == pair.first && old->second == pair.second) {
        slot.back() = memory.take();
        memory.write(slot.back(), old->memory);
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
  std::vector<Touching>().swap(touching);
  touching.resize((group.empty() ? std::min<std::size_t>(piece, slot.size()) : slot.size()) + 2 * width);
}

void PairList::find_touching(Segment& segment, const ContactBodies& bodies) {
  const ContactSphere* const sphere = bodies.state.data();
  Touching* const list = touching.data();
  int end = segment.touching_begin;
  for (int k = segment.begin, g = segment.first_group; k < segment.end; k += lane_width, ++g) {
    const int *const a = &first[k], *const b = &second[k];
    // First sub-spheres follow each other in memory, second ones do not.
    if (k + 4 * lane_width <= n_listed())
      for (int l = 3 * lane_width; l < 4 * lane_width; ++l) __builtin_prefetch(sphere + b[l]);
    const ContactSphere *of_a[lane_width], *of_b[lane_width];
    for (int l = 0; l < lane_width; ++l) of_a[l] = sphere + a[l], of_b[l] = sphere + b[l];
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
    for (; bits; bits &= bits - 1) {
      const int l = __builtin_ctz(bits);
      list[end++] = {a[l], b[l], slot[k + l], k + l};
    }
  }
  segment.touching_end = end;
}

template <Rolling rolling, Cohesion cohesion, bool partial, bool levers>
void PairList::add_segment(const Segment& segment, const ContactLaw& law, ContactBodies& bodies,
                           const ContactTimes& times) {
  constexpr bool whole = remembers_more<rolling, cohesion, partial>;
  const ContactSphere* const sphere = bodies.state.data();
  const ContactMotion* const motion = bodies.motion.data();
  const HalfLine* const centre = bodies.centre.data();
  ContactSum* const sum = bodies.sum.data();
  const int* const body_of = bodies.body.data();
  const auto body = [&](int entry) { return levers ? body_of[entry] : entry; };
  for (int k = segment.touching_begin; k < segment.touching_end; k += width) {
    const int n = std::min(width, segment.touching_end - k);
    const Touching* t = &touching[k];
    Touching tail[width];
    if (n < width) {  // lanes behind the last contact repeat it
      for (int l = 0; l < width; ++l) tail[l] = t[std::min(l, n - 1)];
      t = tail;
    }
    if (k + width < segment.touching_end)
      for (int l = width; l < 2 * width; ++l) {
        const int b = body(t[l].second);
        __builtin_prefetch(motion + b);
        __builtin_prefetch(sum + b, 1);
      }
    LanePair share = LanePair{} + 1.0;
    if (!same_seeds.empty())
      for (int l = 0; l < width; ++l)
        (l < lane_width ? share.a : share.b)[l % lane_width] =
            contact_share(n_in_group[same_seeds[t[l].pair]]);
    const LaneSphere<LanePair, levers> a(RecordsAt{[&](int l) { return sphere + t[l].first; }},
                                         RecordsAt{[&](int l) { return motion + body(t[l].first); }},
                                         RecordsAt{[&](int l) { return centre + body(t[l].first); }}),
        b(RecordsAt{[&](int l) { return sphere + t[l].second; }},
          RecordsAt{[&](int l) { return motion + body(t[l].second); }},
          RecordsAt{[&](int l) { return centre + body(t[l].second); }});
    LaneMemory<LanePair, whole> remembered(RecordsAt{[&](int l) { return memory.first(t[l].line); }},
                                           RecordsAt{[&](int l) { return memory.second(t[l].line); }});
    const auto action = act_between<rolling, cohesion, partial>(law, a, b, share, times, remembered.memory);
    ContactSum on_a[width], on_b[width];
    HalfLine kept[width];
    records_of(action.force, action.torque_a, on_a);
    records_of(-action.force, action.torque_b, on_b);
    remembered.first_half(action.normal_force, kept);
    for (int l = 0; l < n; ++l) {
      *memory.first(t[l].line) = kept[l];
      add(sum[body(t[l].first)], on_a[l]);
      add(sum[body(t[l].second)], on_b[l]);
    }
    if constexpr (whole) {
      remembered.second_half(kept);
      for (int l = 0; l < n; ++l) *memory.second(t[l].line) = kept[l];
    }
  }
}

void PairList::act(const Segment& segment, const ContactLaw& law, ContactBodies& bodies,
                   const ContactTimes& times) {
  with_models(law, [&](auto rolling, auto cohesion, auto partial) {
    constexpr Rolling r = decltype(rolling)::value;
    constexpr Cohesion c = decltype(cohesion)::value;
    constexpr bool p = decltype(partial)::value;
    if constexpr (c == Cohesion::none && !p)
      if (!bodies.levers()) return add_segment<r, c, p, false>(segment, law, bodies, times);
    add_segment<r, c, p, true>(segment, law, bodies, times);
  });
}

// Tested and acted upon in pieces, so that the bodies are still in the cache. Touching pairs that do not fill
// the lanes wait for the next piece.
void PairList::add_in_pieces(const Segment& segment, const ContactLaw& law, ContactBodies& bodies,
                             const ContactTimes& times) {
  int waiting = 0;
  for (int begin = segment.begin; begin < segment.end; begin += piece) {
    Segment part = segment;
    part.begin = begin, part.end = std::min(begin + piece, segment.end);
    part.first_group += (begin - segment.begin) / lane_width;
    part.touching_begin = waiting;
    find_touching(part, bodies);
    const int found = part.touching_end;
    part.touching_begin = 0;
    if (part.end < segment.end) part.touching_end -= found % width;
    act(part, law, bodies, times);
    waiting = found - part.touching_end;
    std::copy_n(touching.begin() + part.touching_end, waiting, touching.begin());
  }
}

void PairList::add_forces(const std::vector<ContactLaw>& laws, ContactBodies& bodies,
                          const ContactTimes& times) {
  if (same_seeds.empty()) {
    for (const Segment& segment : segments) add_in_pieces(segment, laws[segment.law], bodies, times);
    return;
  }
  int begin = 0;
  for (Segment& segment : segments) {
    segment.touching_begin = begin;
    find_touching(segment, bodies);
    begin = segment.touching_end;
  }
  std::fill(n_in_group.begin(), n_in_group.end(), 0);
  for (int k = 0; k < begin; ++k) ++n_in_group[same_seeds[touching[k].pair]];
  for (const Segment& segment : segments) act(segment, laws[segment.law], bodies, times);
}

void PairList::collect(const ContactBodies& bodies, std::vector<ContactHistory::Pair>& out) const {
  for (std::size_t k = 0; k < slot.size(); ++k) {
    if (slot[k] < 0) continue;
    out.push_back({bodies.sphere[first[k]], bodies.sphere[second[k]], {}});
    memory.read(slot[k], out.back().memory);
  }
}

std::size_t PairList::bytes() const {
  return memory.bytes() + near.capacity() +
         sizeof(int) * (first.capacity() + second.capacity() + slot.capacity() + same_seeds.capacity() +
                        n_in_group.capacity()) +
         touching.capacity() * sizeof(Touching);
}

}  // namespace seedflow
