#pragma once

#include <vector>

#include "seedflow/seeds/seed_store.h"

namespace seedflow {

/// Prepares the reduced loads of one lane for substeps of length `step`.
RigidLoad reduce_loads(const SeedTemplate& model, const LoadLanes* loads, int lane, double step);

/// Change of (v, omega) in the lab frame over a kick of length h under contact force and torque; books the
/// impulses.
void kick_reduced(RigidLoad& load, const Quaternion& orientation, const Vec3& force, const Vec3& torque,
                  double h, bool half, Vec3& velocity, Vec3& spin);

/// Writes what each sub-sphere received into LoadLanes::impulse.
void spread_impulses(const RigidLoad& load, const SeedTemplate& model, LoadLanes* loads, int lane,
                     double duration);

}  // namespace seedflow
