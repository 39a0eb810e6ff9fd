#pragma once

#include "seedflow/experiment/command_line.h"

namespace seedflow {

/// `diagnose FILE.prm [--set "Section/Entry=value"]... [--output DIR]`: reads the problem, carries out the
/// diagnosis, writes NAME.diagnosed.prm, diagnosis.json and report.html.
Command diagnose_command();

}  // namespace seedflow
