#pragma once

#include "seedflow/experiment/metering.h"
#include "seedflow/output/report.h"
#include "seedflow/output/summary.h"

namespace seedflow {

/// Two seeds to look at, as in the paper's Fig. 24: A was taken alone, B with others; labels, -1: none.
struct NamedSeeds {
  long a = -1, b = -1;
};
NamedSeeds named_seeds(const SeedingRecord& record);

/// Numbers of seeds of the holes that reached a station.
std::vector<int> counts(const SeedingRecord& record, int Passage::*station);

/// Adds indices at the stations and on the ground, air consumption and the named seeds to the summary.
void add_seeding(const Metering& metering, const Metering::Gathered& gathered, double time, Summary& summary);

/// Writes holes.csv, seed_A.csv, seed_B.csv and landings.csv.
void write_seeding_files(const Metering::Gathered& gathered, const std::filesystem::path& folder);

void write_metering_report(const Metering& metering, const Metering::Gathered& gathered,
                           const GranularRun& run, const Summary& summary, const RunOptions& options);

/// "93 % (88 to 96)".
std::string in_words(const Share& share);

}  // namespace seedflow
