#include "places.h"

namespace seedflow::places {
const char* const source_dir = SEEDFLOW_SOURCE_DIR;
const char* const main_program = SEEDFLOW_MAIN;
const char* const mpiexec = SEEDFLOW_MPIEXEC;
}  // namespace seedflow::places
