#pragma once

#include <iosfwd>
#include <string>

#include "seedflow/seeds/seed_template.h"

namespace seedflow {

/// Seed templates as CSV, one keyword-led row per fact, SI units, '#' starts a comment line, blank lines are
/// skipped:
///
///   name,<text>                    optional
///   volume,<m3>                    of the real seed
///   density,<kg/m3>                of the real seed
///   semi-axes,<a>,<b>,<c>          [m] of the real seed; optional: those of the sphere with this volume
///   centre,<x>,<y>,<z>             [m] of the real seed's shape; optional: the origin
///   frame,<w>,<x>,<y>,<z>          unit quaternion, the shape's axes -> this file's axes; optional: no
///   rotation sphere,<x>,<y>,<z>,<r>[,<rho>] [m]; rho: density relative to the other sub-spheres, in all rows
///   or in none bond,<first>,<second>,<R_b>    sub-spheres by their order in the file from 0, first < second;
///   radius [m]
///
/// Numbers are written with all their digits: reading back what was written gives the same template bit by
/// bit.
void write_template(std::ostream& out, const SeedTemplate& seed);
void write_template(const std::string& file, const SeedTemplate& seed);

/// Reads, finishes and checks a template (one connected piece). `file` is the name used in messages.
/// Errors: InputError with file, line and reason.
SeedTemplate read_template(std::istream& in, const std::string& file);
SeedTemplate read_template(const std::string& file);

}  // namespace seedflow
