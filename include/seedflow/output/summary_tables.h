#pragma once

#include "seedflow/output/report.h"
#include "seedflow/output/summary.h"

namespace seedflow {

/// Adds the heading "Numbers" and the tables of all observables and balances to a report.
void add_summary_tables(const Summary& summary, Report& report);

}  // namespace seedflow
