#pragma once

/// Where the tests find what they read and start. Known to one small file only, so that two checkouts of the
/// same sources share the compiler's cache.
namespace seedflow::places {
extern const char* const source_dir;    ///< the checkout
extern const char* const main_program;  ///< the built seedflow
extern const char* const mpiexec;
}  // namespace seedflow::places
