#include "seedflow/seeds/wall_list.h"

#include <algorithm>
#include <map>
#include <utility>

#include "seedflow/seeds/contact_geometry.h"

namespace seedflow {
namespace {

// Cosine of the angle by which a contact's normal may turn in one substep. A sphere of 0.2 mm radius that
// moves by 10 um around an edge turns by 3 degrees; faces that meet at more than 8 degrees are two contacts.
constexpr double same_direction = 0.99;

}  // namespace

void WallList::set(const std::vector<WallCandidate>& candidates, const std::vector<int>& law,
                   const std::vector<int>& group, const std::vector<int>& block,
                   const std::vector<int>& entry_of, const std::vector<ContactLaw>& laws,
                   const ContactBodies& bodies, const ContactHistory& history) {
  segments.clear(), candidate.clear(), touching.clear(), point.clear(), seat.clear();
  const auto more = [](const ContactLaw& l) { return l.remembers_more(); };
  memory.reset(std::any_of(laws.begin(), laws.end(), more), history.on_wall.size());
  std::map<std::pair<int, int>, int> seat_of;
  for (int l = 0; l < static_cast<int>(laws.size()); ++l) {
    Segment segment{l, static_cast<int>(candidate.size()), 0, 0};
    auto old = history.on_wall.begin();
    for (std::size_t k = 0; k < candidates.size(); ++k) {
      if (law[k] != l) continue;
      const WallCandidate& c = candidates[k];
      const auto place = seat_of.emplace(std::make_pair(block[k], c.wall), static_cast<int>(seat.size()));
      if (place.second) seat.push_back({block[k], c.wall, {}});
      const int number = static_cast<int>(candidate.size());
      candidate.push_back({entry_of[c.sphere], c.wall, group.empty() ? -1 : group[k], place.first->second});
      segment.reach = std::max(segment.reach, laws[l].reach(radius_of(bodies.state[entry_of[c.sphere]])));
      while (old != history.on_wall.end() &&
             (old->sphere != c.sphere ? old->sphere < c.sphere : old->wall < c.wall))
        ++old;
      for (; old != history.on_wall.end() && old->sphere == c.sphere && old->wall == c.wall; ++old) {
        touching.push_back({number, old->feature, memory.take()});
        memory.write(touching.back().line, old->memory);
        std::copy_n(old->normal, 3, point.emplace_back().value);
      }
    }
    segment.end = static_cast<int>(candidate.size());
    if (segment.end > segment.begin) segments.push_back(segment);
  }
  n_in_group.assign(group.empty() ? 0 : *std::max_element(group.begin(), group.end()) + 1, 0);
}

int WallList::inherited_line(std::vector<Touching>::iterator old, std::vector<Touching>::iterator last,
                             int present) {
  auto from = last;
  double best = same_direction;
  for (; old != last; ++old) {
    if (old->line < 0) continue;
    const CacheLine &a = point[present], &b = point_before[old - before.begin()];
    const double cosine = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    if (cosine > best) best = cosine, from = old;
  }
  return from != last ? std::exchange(from->line, -1) : memory.take();
}

void WallList::find_touching(Segment& segment, const std::vector<Wall>& walls,
                             const std::vector<Placement>& place, const ContactBodies& bodies) {
  segment.touching_begin = static_cast<int>(touching.size());
  auto old = std::lower_bound(before.begin(), before.end(), segment.begin,
                              [](const Touching& t, int number) { return t.candidate < number; });
  for (int k = segment.begin; k < segment.end; ++k) {
    const Candidate& c = candidate[k];
    const ContactSphere& sphere = bodies.state[c.entry];
    found.clear();
    contacts_near(walls[c.wall], place[c.wall], centre_of(sphere), radius_of(sphere) + segment.reach, found);
    auto last = old;
    while (last != before.end() && last->candidate == k) ++last;
    const int first_found = static_cast<int>(touching.size());
    for (const WallPoint& p : found) {
      if (p.distance < 0 && first_fault.sphere < 0) first_fault = {bodies.sphere[c.entry], c.wall};
      const auto same =
          std::find_if(old, last, [&](const Touching& t) { return t.feature == p.feature && t.line >= 0; });
      // A two-sided surface pushes to where the centre is: deep in it and turned around is through it.
      if (same != last && p.distance < 0.5 * radius_of(sphere) && first_fault.sphere < 0) {
        const CacheLine& b = point_before[same - before.begin()];
        if (p.normal.x * b[0] + p.normal.y * b[1] + p.normal.z * b[2] < 0)
          first_fault = {bodies.sphere[c.entry], c.wall};
      }
      touching.push_back({k, p.feature, same != last ? std::exchange(same->line, -1) : -1});
      point.push_back(
          {{p.normal.x, p.normal.y, p.normal.z, p.distance, p.velocity.x, p.velocity.y, p.velocity.z, 0}});
    }
    for (int t = first_found; t < static_cast<int>(touching.size()); ++t)
      if (touching[t].line < 0) touching[t].line = inherited_line(old, last, t);
    for (; old != last; ++old)
      if (old->line >= 0) memory.release(old->line);
  }
  segment.touching_end = static_cast<int>(touching.size());
}

template <Rolling rolling, Cohesion cohesion, bool partial, bool levers>
void WallList::add_segment(const Segment& segment, const ContactLaw& law, ContactBodies& bodies,
                           const ContactTimes& times) {
  constexpr bool whole = remembers_more<rolling, cohesion, partial>;
  for (int k = segment.touching_begin; k < segment.touching_end; k += lane_width) {
    const int n = std::min(lane_width, segment.touching_end - k);
    const Candidate* who[lane_width];
    int body[lane_width];
    Lanes share = Lanes{} + 1.0;
    const auto number = [&](int l) { return k + std::min(l, n - 1); };
    for (int l = 0; l < lane_width; ++l) {
      who[l] = &candidate[touching[number(l)].candidate];
      body[l] = bodies.body[who[l]->entry];
      if (who[l]->group >= 0) share[l] = contact_share(n_in_group[who[l]->group]);
    }
    const LaneSphere<Lanes, levers> a(RecordsAt{[&](int l) { return &bodies.state[who[l]->entry]; }},
                                      RecordsAt{[&](int l) { return &bodies.motion[body[l]]; }},
                                      RecordsAt{[&](int l) { return &bodies.centre[body[l]]; }});
    LaneMemory<Lanes, whole> remembered(
        RecordsAt{[&](int l) { return memory.first(touching[number(l)].line); }},
        RecordsAt{[&](int l) { return memory.second(touching[number(l)].line); }});
    Lanes p[8];
    load_columns(RecordsAt{[&](int l) { return &point[number(l)]; }}, p);
    const auto action =
        act_on_wall<rolling, cohesion, partial>(law, a, LaneVec3{p[0], p[1], p[2]}, p[3],
                                                LaneVec3{p[4], p[5], p[6]}, share, times, remembered.memory);
    ContactSum on_a[lane_width];
    HalfLine kept[lane_width];
    records_of(action.force, action.torque_a, on_a);
    remembered.first_half(action.normal_force, kept);
    for (int l = 0; l < n; ++l) {
      *memory.first(touching[k + l].line) = kept[l];
      add(bodies.sum[body[l]], on_a[l]);
      seat[who[l]->seat].force += Vec3{on_a[l][0], on_a[l][1], on_a[l][2]};
    }
    if constexpr (whole) {
      remembered.second_half(kept);
      for (int l = 0; l < n; ++l) *memory.second(touching[k + l].line) = kept[l];
    }
  }
}

void WallList::add_forces(const std::vector<ContactLaw>& laws, const std::vector<Wall>& walls,
                          const std::vector<Placement>& place, ContactBodies& bodies,
                          const ContactTimes& times) {
  std::swap(touching, before), std::swap(point, point_before);
  touching.clear(), point.clear();
  for (Segment& segment : segments) find_touching(segment, walls, place, bodies);
  std::fill(n_in_group.begin(), n_in_group.end(), 0);
  for (const Touching& t : touching)
    if (candidate[t.candidate].group >= 0) ++n_in_group[candidate[t.candidate].group];
  for (Seat& s : seat) s.force = Vec3{};
  for (const Segment& segment : segments)
    with_models(laws[segment.law], [&](auto rolling, auto cohesion, auto partial) {
      constexpr Rolling r = decltype(rolling)::value;
      constexpr Cohesion c = decltype(cohesion)::value;
      constexpr bool p = decltype(partial)::value;
      if constexpr (c == Cohesion::none && !p)
        if (!bodies.levers()) return add_segment<r, c, p, false>(segment, laws[segment.law], bodies, times);
      add_segment<r, c, p, true>(segment, laws[segment.law], bodies, times);
    });
}

void WallList::collect(const ContactBodies& bodies, std::vector<ContactHistory::OnWall>& out) const {
  for (std::size_t k = 0; k < touching.size(); ++k) {
    const Touching& t = touching[k];
    const Candidate& c = candidate[t.candidate];
    ContactHistory::OnWall contact{bodies.sphere[c.entry], c.wall, t.feature, {}, {}};
    memory.read(t.line, contact.memory);
    std::copy_n(point[k].value, 3, contact.normal);
    out.push_back(contact);
  }
}

void WallList::add_wall_forces(double factor, int n_walls, std::vector<Vec3>& sum) const {
  for (const Seat& s : seat) sum[static_cast<std::size_t>(s.block) * n_walls + s.wall] += factor * s.force;
}

std::size_t WallList::bytes() const {
  return memory.bytes() + candidate.capacity() * sizeof(Candidate) +
         (touching.capacity() + before.capacity()) * sizeof(Touching) +
         (point.capacity() + point_before.capacity()) * sizeof(CacheLine) + seat.capacity() * sizeof(Seat) +
         n_in_group.capacity() * sizeof(int);
}

}  // namespace seedflow
