#pragma once

#include "seedflow/diagnose/selection.h"

namespace seedflow {

/// What a law outside the catalogue looks like: a force along one direction whose strength is a product of
/// powers of dimensionless groups, found among a library of such terms by their simulated effect on the
/// observables (so the law is judged in integral form, never by differentiating data) and refined by
/// Gauss-Newton steps with real runs. Needs the effect "Inferred law"; nothing is found without it.
InferredLaw infer_law(ObservableModel& model, Responses& responses, Weighing& weighing,
                      const DataNoise& noise, const Split& split, Diagnosis& answer);

}  // namespace seedflow
