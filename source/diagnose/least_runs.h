#pragma once

#include "seedflow/diagnose/observable_model.h"

namespace seedflow {

/// The fewest runs a diagnosis can do with: base model, winner, every input and every candidate once.
inline long least_runs(const ObservableModel& model) {
  return static_cast<long>(model.conditions().size()) * model.repeats() *
         static_cast<long>(2 + model.nuisances().size() + model.candidates().size());
}

}  // namespace seedflow
