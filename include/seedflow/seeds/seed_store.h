#pragma once

#include <vector>

#include "seedflow/seeds/lane_vector.h"
#include "seedflow/seeds/seed_template.h"

namespace seedflow {

/// The state of one sub-sphere of lane_width seeds (lab frame, SI units).
struct SphereLanes {
  LaneVec3 position;           ///< [m]
  LaneQuaternion orientation;  ///< template frame to lab frame
  LaneVec3 velocity;           ///< [m/s]
  LaneVec3 angular_velocity;   ///< [rad/s]
};

/// What bonds and contacts do to one sub-sphere, or one rigid body, of lane_width seeds. Kept only from one
/// advance() to the next; in between forces are summed in one scratch block that stays in the cache.
struct ForceLanes {
  LaneVec3 force;   ///< [N]
  LaneVec3 torque;  ///< [N m]
};

/// What acts on one sub-sphere from outside: force + drag (flow - velocity) - added_mass d velocity/dt.
struct LoadLanes {
  LaneVec3 force;           ///< [N]
  LaneVec3 torque;          ///< [N m]
  LaneVec3 flow;            ///< flow velocity [m/s]
  Lanes drag = {};          ///< [kg/s]
  Lanes added_mass = {};    ///< [kg]
  Lanes relaxed_half = {};  ///< (1 - exp(-z))/z with z = drag h/(mass + added mass) and h half a substep
  Lanes relaxed_full = {};  ///< the same for a whole substep
  LaneVec3 impulse;         ///< received through drag and added mass since advance() began [N s]
};

/// A rigid seed in each lane.
struct BodyLanes {
  LaneVec3 position;  ///< centre of mass [m]
  LaneQuaternion orientation;
  LaneVec3 velocity;          ///< [m/s]
  LaneVec3 angular_momentum;  ///< lab frame [kg m2/s]
};

/// Drag and added mass on one rigid seed, reduced to its six degrees of freedom V = (v, omega), both in the
/// template's frame, where they do not change while the seed turns. During a kick of length h
///   M dV/dt = G - K V,   M = own inertia + sum m_a D^T D,   K = sum k D^T D,   D V = v + omega x r,
/// is solved exactly: with the generalised eigenvectors X of (K, M) and eigenvalues lambda,
///   mean V = V + h X phi_2(h lambda) X^T (G - K V),   phi_2(z) = (z - 1 + exp(-z))/z^2,
///   change of V = h X X^T (G - K mean V),
/// so that the impulse on each sub-sphere, h k (u - mean v) - m_a change of v, adds up to what the seed
/// receives.
struct RigidLoad {
  double drag[36];                      ///< K, row by row
  double mobility[36];                  ///< X X^T = M^-1
  double mean_half[36], mean_full[36];  ///< X phi_2 X^T for half a substep and a whole one
  Vec3 force, torque;                   ///< sum of f + k u and of the given torques, lab frame
  Vec3 moment[3];  ///< moment[c] = sum r_c (f + k u): the torque is sum of (R e_c) x moment[c]
  // Summed since advance() began; a sub-sphere at r (template frame) has path = path + path_arm r and so on.
  Vec3 path, path_arm[3];      ///< integral of v dt [m]
  Vec3 change, change_arm[3];  ///< sum of changes of v [m/s]
};

/// All seeds of one template. Lane = seed: lane_width seeds make a block, and the sub-spheres of a block
/// stand one after the other, [block][sub-sphere][component][lane], so that one bond of the template is the
/// same pair of addresses for all seeds of the block. Empty lanes of the last block rest in the template's
/// reference position. Rigid seeds store bodies only; where their sub-spheres are is computed when asked.
struct SeedStore {
  SeedTemplate model;
  int material = 0;
  bool rigid = false;
  std::vector<int> seed;               ///< [slot] the user's seed number; slot = block * lane_width + lane
  std::vector<Lanes> occupied;         ///< [block] 1 where the lane holds a seed, else 0
  std::vector<SphereLanes> sphere;     ///< [block * n_spheres + sub-sphere], bonded seeds only
  std::vector<ForceLanes> force;       ///< as sphere; at the end of advance()
  std::vector<BodyLanes> body;         ///< [block], rigid seeds only
  std::vector<ForceLanes> body_force;  ///< as body; at the end of advance()
  std::vector<LoadLanes> load;  ///< [block * n_spheres + sub-sphere]; empty while nothing acts from outside
  std::vector<RigidLoad> rigid_load;  ///< [slot], rigid seeds under outside loads only

  int n_blocks() const { return static_cast<int>(occupied.size()); }
  int n_spheres() const { return model.n_spheres(); }
  SphereLanes* block(int b) { return sphere.data() + static_cast<std::size_t>(b) * n_spheres(); }
  const SphereLanes* block(int b) const { return sphere.data() + static_cast<std::size_t>(b) * n_spheres(); }
  ForceLanes* forces(int b) { return force.data() + static_cast<std::size_t>(b) * n_spheres(); }
  LoadLanes* loads(int b) {
    return load.empty() ? nullptr : load.data() + static_cast<std::size_t>(b) * n_spheres();
  }

  /// Calls f(sub-sphere, position) for all sub-spheres of the seed in this slot.
  template <class F>
  void positions(int slot, const F& f) const {
    const int lane = slot % lane_width, b = slot / lane_width;
    if (!rigid) {
      for (int i = 0; i < n_spheres(); ++i) f(i, block(b)[i].position.get(lane));
      return;
    }
    const Vec3 centre = body[b].position.get(lane);
    const Quaternion q = body[b].orientation.get(lane);
    const Vec3 x = rotate(q, {1, 0, 0}), y = rotate(q, {0, 1, 0}), z = rotate(q, {0, 0, 1});
    for (int i = 0; i < n_spheres(); ++i) {
      const Vec3& r = model.position[i];
      f(i, centre + (r.x * x + r.y * y + r.z * z));
    }
  }
  /// Calls f(sub-sphere, velocity, angular velocity) for all sub-spheres of the seed in this slot.
  template <class F>
  void velocities(int slot, const F& f) const {
    const int lane = slot % lane_width, b = slot / lane_width;
    if (!rigid) {
      for (int i = 0; i < n_spheres(); ++i)
        f(i, block(b)[i].velocity.get(lane), block(b)[i].angular_velocity.get(lane));
      return;
    }
    const Vec3 velocity = body[b].velocity.get(lane), spin = body_spin(slot);
    const Quaternion q = body[b].orientation.get(lane);
    for (int i = 0; i < n_spheres(); ++i) f(i, velocity + cross(spin, rotate(q, model.position[i])), spin);
  }
  /// Angular velocity of a rigid seed [rad/s].
  Vec3 body_spin(int slot) const;

  /// Puts a seed into the next free lane and returns its slot.
  int add(int seed_number, const Vec3& centre, const Quaternion& orientation, const Vec3& velocity,
          const Vec3& spin);
  /// Slot k holds from now on what slot from[k] held; slots not named are gone.
  void rearrange(const std::vector<int>& from);
  std::size_t bytes() const;

 private:
  void add_block();
};

}  // namespace seedflow
