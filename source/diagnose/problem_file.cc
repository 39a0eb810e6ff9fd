#include "seedflow/diagnose/problem_file.h"

#include <cmath>
#include <ostream>

#include "seedflow/base/error.h"
#include "seedflow/base/parameter_file.h"
#include "seedflow/base/trim.h"
#include "seedflow/base/units.h"
#include "seedflow/diagnose/candidate.h"

namespace seedflow {

namespace {

/// Overrides of the diagnosis itself, and those of the model.
struct Overrides {
  std::vector<std::string> own, model;
  explicit Overrides(const std::vector<std::string>& all) {
    for (const std::string& text : all)
      (scan_override(text).sections.empty() && scan_override(text).name != "Experiment" ? own : model)
          .push_back(text);
  }
};

}  // namespace

void ProblemFile::declare(Parameters& p) {
  p.file("Model", model, "The .prm of the base model, as it would be run.");
  p.file("Measurements", measurements,
         "CSV: condition,quantity,unit,coordinate,coordinate_unit,value,standard_uncertainty.");
  p.file("Conditions", conditions, "CSV: condition,held_out, and one column per entry that differs.");
  p.file("Possible experiments", possible_experiments,
         "CSV like Conditions: what could be measured next. Nothing: variations of the conditions.");
  p.texts("Candidates", candidates,
          "Effects of the catalogue that may be missing, by name, or PATH = VALUE for an entry that is 0 "
          "without the effect and VALUE "
          "with it, or PATH = OPTION for a choice. Nothing: every effect of the catalogue that is off in the "
          "model.");
  p.texts(
      "Nuisances", nuisances,
      "Inputs with their standard uncertainty, as in Seeds/Diameter +- 1 %; with the word each behind it, "
      "every condition has an error of its own. Nothing: those usual for the experiment.");
  p.integer("Runs", runs, {1, 1e9, false}, "The most runs of single conditions.");
  p.integer("Repeats", repeats, Range::between(2, 1000),
            "Of every run with other random numbers, where repetitions of the experiment scatter.");
  p.choice(
      "Runs of other builds", other_builds, {"ignore", "use"},
      "Finished runs in the output folder that another build of the program made: ignore makes them again, "
      "use trusts them.");
  p.integer("Effects at once", largest_names, Range::between(1, 3), "The most effects to name together.");
}

Nuisance read_nuisance(const std::string& text) {
  const std::size_t sign = text.find("+-");
  const auto fail = [&](const std::string& why) {
    throw InputError("Nuisances: \"" + text + "\": " + why +
                     " Write an entry and its standard uncertainty, as in Seeds/Diameter +- 1 %.");
  };
  if (sign == std::string::npos) fail("\"+-\" is missing.");
  Nuisance nuisance;
  nuisance.path = trim(text.substr(0, sign));
  nuisance.name = nuisance.path;
  std::string size = trim(text.substr(sign + 2));
  if (size.size() > 5 && size.compare(size.size() - 5, 5, " each") == 0) {
    nuisance.each_condition = true;
    nuisance.name += " of a condition";
    size = trim(size.substr(0, size.size() - 5));
  }
  try {
    const NumberWithUnit parts = split_unit(size);
    const Unit unit = parts.unit.empty() ? Unit() : parse_unit(parts.unit);
    nuisance.relative = parts.unit == "%";
    nuisance.unit = parts.unit;
    nuisance.standard_deviation = std::stod(parts.number) * unit.factor * std::pow(10.0, unit.exponent);
  } catch (const InputError& error) {
    fail(error.what());
  }
  if (!(nuisance.standard_deviation > 0)) fail("the uncertainty must be positive.");
  return nuisance;
}

Problem read_problem(const std::string& file, const std::vector<std::string>& overrides) {
  ProblemFile input;
  Parameters parameters;
  input.declare(parameters);
  Problem problem;
  const Overrides split(overrides);
  problem.overrides = split.model;
  if (const ParameterLine line = find_parameter_line(file, {}, "Experiment"); !line.name.empty())
    throw InputError(line.where + ": this is the parameter file of an experiment (" + line.value +
                     "), which runs with\n  ./seedflow run " + file +
                     "\nA diagnosis has a file of its own:\n  set Model        = " +
                     std::filesystem::path(file).filename().string() +
                     "\n  set Measurements = measurements.csv\n  set Conditions   = conditions.csv\n"
                     "doc/diagnosis.md tells what stands in the two; prm/diagnosis/ has examples.");
  parameters.read(file, split.own);
  for (const char* needed : {"Model", "Measurements", "Conditions"})
    if (parameters.value(needed).empty()) parameters.reject(needed, "it is missing", "name a file");
  problem.name = std::filesystem::path(file).stem().string();
  problem.prm = input.model;
  problem.measurements = read_measurements(input.measurements);
  problem.conditions = read_conditions(input.conditions);
  if (!input.possible_experiments.empty())
    problem.possible_experiments = read_conditions(input.possible_experiments);
  for (const char* entry : {"Candidates", "Nuisances", "Runs", "Conditions"})
    if (const ParameterLine line = find_parameter_line(file, split.own, entry); !line.name.empty())
      problem.where[entry] = line.where;
  const auto read_list = [&](const char* entry, const auto& texts, const auto& read, auto& into) {
    for (const std::string& text : texts) try {
        into.push_back(read(text));
      } catch (const InputError& error) {
        throw InputError(problem.where[entry] + ": " + error.what());
      }
  };
  read_list("Candidates", input.candidates, read_candidate, problem.candidates);
  read_list("Nuisances", input.nuisances, read_nuisance, problem.nuisances);
  problem.budget = {input.runs, input.largest_names, input.repeats};
  return problem;
}

OtherBuilds read_other_builds(const std::string& file, const std::vector<std::string>& overrides) {
  ProblemFile input;
  Parameters parameters;
  input.declare(parameters);
  parameters.read(file, Overrides(overrides).own);
  return input.other_builds == "use" ? OtherBuilds::use : OtherBuilds::ignore;
}

void describe_problem_file(std::ostream& out) {
  ProblemFile input;
  Parameters parameters;
  input.declare(parameters);
  parameters.describe(out);
}

}  // namespace seedflow
