#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "seedflow/experiment/measurements.h"

namespace seedflow {

/// A missing effect that may explain a disagreement: entries of the .prm that make it up, each with the value
/// at which it is absent and the published one. The amplitude a scales between them,
/// value = absent + a (published - absent), and has the prior N(1, 0.25), zero excluded.
struct Candidate {
  struct Entry {
    std::string path;                  ///< "Effects/Added mass/Strength"
    double absent = 0, published = 1;  ///< SI
    /// Path of a number that `published` is a share of, under every condition anew; or "".
    std::string of = "";
    std::string unit = "";  ///< in which it was written; "": the entry's
  };
  std::string name;
  std::vector<Entry> entries;
  /// Further entries that are no numbers, "PATH=VALUE", made where the amplitude is above 1/2. A candidate of
  /// choices alone is there or not: its response to the amplitude is taken as proportional.
  std::vector<std::string> choices = {};
};

/// An input known with some uncertainty. Where the conditions give the entry different values, every value
/// has an error of its own; otherwise all conditions share one.
struct Nuisance {
  std::string name;  ///< in words: "viscosity"
  std::string path;  ///< "Fluid/Dynamic viscosity"
  double standard_deviation = 0.01;
  bool relative = true;  ///< of the value; otherwise in the entry's SI unit
  bool each_condition =
      false;              ///< every condition has an error of its own whatever its value (a release time)
  std::string unit = "";  ///< in which it was written; "": the entry's
};

struct Budget {
  long runs = 100000;     ///< of the simulation, of one condition each
  int largest_names = 3;  ///< effects at once
  int repeats = 3;        ///< with other random numbers, of experiments whose repetitions scatter
};

/// What is asked: which effect is missing between the model `prm` and the measurements?
struct Problem {
  std::string name = "diagnosis";
  std::string prm;                        ///< file of the base model; its entry Experiment says which
  std::vector<std::string> overrides;     ///< "Section/Entry=value", for all conditions
  std::vector<Measurement> measurements;  ///< in the units of the experiment's observables
  std::vector<Condition> conditions;
  std::vector<Candidate> candidates;  ///< empty: every effect of the catalogue that is off in the base model
  std::vector<Nuisance> nuisances;    ///< empty: those usual for the experiment
  std::vector<Condition> possible_experiments;  ///< to choose from; empty: variations of the conditions
  Budget budget;
  std::map<std::string, std::string> where = {};  ///< "file:line" of entries of the problem's own file
};

enum class Verdict { named, none, ambiguous, not_in_catalogue, input_uncertain, numerics_dominate };
/// "NAMED", "NONE", "AMBIGUOUS", "NOT IN CATALOGUE", "INPUT UNCERTAIN", "NUMERICS DOMINATE"
std::string verdict_name(Verdict verdict);

/// A number with its 95 % interval.
struct Interval {
  double value = 0, low = 0, high = 0;
};

struct NamedEffect {
  std::string name;
  Interval amplitude;  ///< 1: the published coefficients
};

/// An explanation that was weighed: none, one to three candidates, or an input that is off.
struct Explanation {
  std::vector<std::string> names;  ///< empty: nothing is missing
  std::string input;               ///< the nuisance given free rein, or ""
  double log_evidence = 0;         ///< on the training conditions, price of multiplicity included
  double log_evidence_all = 0;     ///< on all conditions
  double posterior = 0;            ///< among all explanations weighed, from all conditions
  double chi2_training = 0,
         chi2_held_out = 0;  ///< per point, own uncertainty and that of the fit in the denominator
  std::vector<NamedEffect> effects;
  std::string why_lost;  ///< "" for the winner
};

/// Where measured and simulated values differ. Ranked, the most striking place first.
struct Place {
  std::string axis;  ///< "condition", "quantity", "time", "Reynolds number", ...
  std::string bin;   ///< name of the condition, or the range
  double low = 0, high = 0;
  double statistic = 0;  ///< standard deviations
  double p_value = 1;    ///< by permutation, the largest statistic over all bins compared
};

/// One condition before and after.
struct Gap {
  std::string condition;
  bool held_out = false;
  int points = 0;
  double chi2_before = 0, chi2_after = 0;  ///< per point, measurement uncertainty alone in the denominator
  double deviation_before = 0, deviation_after = 0;  ///< rms, in standard deviations of the prediction
};

struct SuggestedExperiment {
  Condition condition;
  double separation = 0;  ///< expected difference of the rivals [standard deviations]
  bool found = false;
};

/// Force = coefficient * product of groups^exponent * reference force along `direction`.
struct InferredLaw {
  bool found = false;
  std::string direction;
  Interval coefficient;
  struct Factor {
    std::string group;  ///< "Reynolds number", ...
    Interval exponent;
  };
  std::vector<Factor> factors;
  std::string text;  ///< the law as a formula
};

struct RunRecord {
  std::string condition;
  std::string command;                 ///< that makes the run by itself
  std::vector<std::string> overrides;  ///< what it has besides the condition's
  std::string status;                  ///< "done", or why it failed
  double seconds = 0;
};

/// The answer.
struct Diagnosis {
  Verdict verdict = Verdict::none;
  std::string sentence;                           ///< in plain words
  std::vector<NamedEffect> effects;               ///< NAMED
  std::vector<std::vector<std::string>> rivals;   ///< AMBIGUOUS: explanations that cannot be told apart
  std::string input;                              ///< INPUT UNCERTAIN: which
  Interval input_value;                           ///< in units of its prior's standard deviation
  SuggestedExperiment suggestion;                 ///< AMBIGUOUS
  InferredLaw law;                                ///< NOT IN CATALOGUE
  std::vector<Explanation> explanations;          ///< ranked
  std::vector<std::vector<std::string>> classes;  ///< candidates whose signatures are parallel, |rho| > 0.95
  std::vector<Place> places;
  std::vector<Gap> gaps;
  std::vector<std::string> remarks;    ///< idle effects, outliers, failed runs, scale of the scatter
  std::vector<std::string> overrides;  ///< what turns the base .prm into the diagnosed one
  double noise_scale = 1;              ///< scatter of the data over the stated uncertainty
  double explained = 0;                ///< share of the gap that the verdict explains
  std::vector<RunRecord> run_list;     ///< every run
  long runs = 0, runs_computed = 0;    ///< asked for; computed now and not remembered
  /// Values at all measured points: before, and after with everything fitted.
  std::vector<double> before, after;
  std::vector<double> unit_scale;  ///< SI value over value in the unit of the measurement, per point
};

class RunStore;

/// Carries out the diagnosis. Errors: InputError for a problem that cannot be posed (unknown conditions,
/// quantities, entries; wrong units; coordinates that no run has); RunError if all training conditions' base
/// runs fail; any other run that fails is recorded and survived. `store` remembers runs across diagnoses of
/// the same model.
Diagnosis diagnose(const Problem& problem, RunStore& store);
Diagnosis diagnose(const Problem& problem);

}  // namespace seedflow
