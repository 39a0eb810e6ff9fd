#pragma once

#include <filesystem>

#include "seedflow/diagnose/diagnosis.h"

namespace seedflow {

/// diagnosis.json: verdict, sentence, effects with amplitudes, explanations with posteriors, places, gaps per
/// condition, suggested experiment, inferred law, remarks, every run with its command and status.
void write_diagnosis(const std::filesystem::path& file, const Problem& problem, const Diagnosis& answer);

/// report.html: the answer in a sentence; where; the candidates and why each lost; before and after; what to
/// measure next.
void write_diagnosis_report(const std::filesystem::path& file, const Problem& problem,
                            const Diagnosis& answer, const std::string& command);

/// The base model with what was found, complete and ready to run.
void write_diagnosed_model(const std::filesystem::path& file, const Problem& problem,
                           const Diagnosis& answer);

}  // namespace seedflow
