#pragma once

#include <string>

#include "seedflow/experiment/experiment.h"

namespace seedflow {

/// What to type for this run again: ./seedflow FILE.prm --set "Section/Entry=value" ...
inline std::string command_of(const RunOptions& options) {
  std::string command = "./seedflow " + options.prm;
  for (const std::string& override : options.overrides) command += " --set \"" + override + "\"";
  return command;
}

}  // namespace seedflow
