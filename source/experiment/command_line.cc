#include "seedflow/experiment/command_line.h"

#include <algorithm>
#include <filesystem>
#include <functional>
#include <iomanip>
#include <ostream>
#include <sstream>

#include "seedflow/base/error.h"
#include "seedflow/base/nearest_name.h"
#include "seedflow/base/parameter_file.h"
#include "seedflow/effects/catalogue.h"
#include "seedflow/experiment/bench_report.h"

namespace seedflow {
namespace {

using Arguments = std::vector<std::string>;

template <typename Table>
std::vector<std::string> names_of(const Table& table) {
  std::vector<std::string> names;
  for (const auto& row : table) names.push_back(row.name);
  return names;
}

bool is_parameter_file(const std::string& argument) {
  return argument.size() > 4 && argument.compare(argument.size() - 4, 4, ".prm") == 0;
}

}  // namespace

RunOptions read_run_options(const Arguments& arguments) {
  const std::vector<std::string> known = {"--set", "--output", "--resume", "--dry-run", "--mpi"};
  RunOptions options;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    std::string option = arguments[i], value;
    if (option.compare(0, 2, "--") != 0) {
      if (!options.prm.empty())
        throw InputError("\"" + option + "\": there is one parameter file per run already, \"" + options.prm +
                         "\". Options begin with --.");
      options.prm = option;
      continue;
    }
    const std::size_t equals = option.find('=');
    const bool attached = equals != std::string::npos;
    if (attached) {
      value = option.substr(equals + 1);
      option.erase(equals);
    }
    const auto needs_value = [&](const std::string& example) {
      if (!attached && ++i < arguments.size()) value = arguments[i];
      if (value.empty()) throw InputError(option + " needs a value, as in " + option + " " + example + ".");
      return value;
    };
    if (option == "--set") {
      options.overrides.push_back(needs_value("\"Air/Dynamic viscosity=0.02\""));
    } else if (option == "--output") {
      options.output = needs_value("output/trial");
    } else if ((option == "--resume" || option == "--dry-run") && attached) {
      throw InputError(option + " takes no value.");
    } else if (option == "--resume") {
      options.resume = true;
    } else if (option == "--dry-run") {
      options.dry_run = true;
    } else if (option == "--mpi") {
      throw InputError("--mpi is an option of the launcher: ./seedflow run FILE.prm --mpi 2.");
    } else {
      throw InputError("option " + option + " is not known. " + suggestion(option, known, "option"));
    }
  }
  if (options.prm.empty()) throw InputError("run needs a parameter file, as in: run prm/settling.prm.");
  if (options.output.empty()) options.output = "output/" + std::filesystem::path(options.prm).stem().string();
  return options;
}

namespace {

/// The experiment that the parameter file names.
const Experiment& experiment_of(const CommandLine& program, const RunOptions& options) {
  const ParameterLine line = find_parameter_line(options.prm, options.overrides, "Experiment");
  const std::vector<std::string> names = names_of(program.experiments);
  if (line.name.empty() && !find_parameter_line(options.prm, options.overrides, "Measurements").name.empty())
    throw InputError(options.prm +
                     ": this is the file of a diagnosis, which is made with\n  ./seedflow diagnose " +
                     options.prm);
  if (line.name.empty())
    throw InputError(options.prm +
                     ": the entry \"Experiment\" is missing. Add a line `set Experiment = NAME`. " +
                     suggestion("", names, "experiment"));
  for (const Experiment& experiment : program.experiments)
    if (experiment.name == line.value) return experiment;
  throw InputError(line.where + ": entry \"Experiment\" = \"" + line.value + "\" is not known. " +
                   suggestion(line.value, names, "experiment"));
}

int run(const CommandLine& program, const Arguments& arguments, std::ostream&) {
  const RunOptions options = read_run_options(arguments);
  return experiment_of(program, options).run(options);
}

int geometry(const CommandLine& program, const Arguments& arguments, std::ostream&) {
  RunOptions options = read_run_options(arguments);
  if (options.resume || options.dry_run)
    throw InputError("geometry takes no --resume and no --dry-run; it takes --set and --output.");
  const bool has_output = std::any_of(arguments.begin(), arguments.end(), [](const std::string& argument) {
    return argument.compare(0, 8, "--output") == 0;
  });
  if (!has_output) options.output += "_geometry";
  const Experiment& experiment = experiment_of(program, options);
  if (!experiment.geometry)
    throw InputError(options.prm + ": the experiment \"" + experiment.name +
                     "\" has no geometry to be written. Use a file of Experiment = metering.");
  return experiment.geometry(options);
}

std::string optional_argument(const Arguments& arguments, const std::string& command) {
  for (const std::string& argument : arguments)
    if (argument.compare(0, 2, "--") == 0)
      throw InputError("option " + argument + " is not known; " + command + " has none.");
  if (arguments.size() > 1)
    throw InputError("\"" + arguments[1] + "\": " + command +
                     " takes one name at most. Put a name with blanks in " + "quotation marks.");
  return arguments.empty() ? "" : arguments[0];
}

/// The reference of each experiment; the sections which several experiments have in common are written once.
int parameters(const CommandLine& program, const Arguments& arguments, std::ostream& out) {
  const std::string section = optional_argument(arguments, "parameters");
  std::vector<std::pair<std::string, std::string>> texts;  // text, names of the experiments
  std::string last_error;
  for (const Experiment& experiment : program.experiments) {
    std::ostringstream text;
    try {
      experiment.describe(text, section);
    } catch (const InputError& error) {
      last_error = error.what();
      continue;
    }
    const auto same =
        std::find_if(texts.begin(), texts.end(), [&](const auto& t) { return t.first == text.str(); });
    if (same == texts.end())
      texts.emplace_back(text.str(), experiment.name);
    else
      same->second += ", " + experiment.name;
  }
  if (texts.empty() && !last_error.empty()) throw InputError(last_error);
  if (program.rank == 0)
    for (const auto& [text, names] : texts) out << "Experiment = " << names << "\n\n" << text;
  return exit_done;
}

int effects(const CommandLine& program, const Arguments& arguments, std::ostream& out) {
  std::ostringstream text;
  describe_effects(text, optional_argument(arguments, "effects"));
  if (program.rank == 0) out << text.str();
  return exit_done;
}

int bench(const CommandLine& program, const Arguments& arguments, std::ostream& out) {
  const std::string name = optional_argument(arguments, "bench");
  std::vector<Bench> chosen;
  for (const Bench& candidate : program.benches)
    if (name.empty() || candidate.name == name) chosen.push_back(candidate);
  if (chosen.empty())
    throw InputError("benchmark \"" + name + "\" is not known. " +
                     suggestion(name, names_of(program.benches), "benchmark"));
  std::vector<BenchResult> results;
  for (const Bench& one : chosen) {
    if (program.rank == 0) out << one.name << ": " << one.description << std::endl;
    const std::vector<BenchResult> measured = one.run();
    if (program.rank == 0) print_bench_table(measured, out);
    results.insert(results.end(), measured.begin(), measured.end());
  }
  if (program.rank == 0) write_bench_file(results, "bench.json");
  return exit_done;
}

int help(const CommandLine& program, const Arguments&, std::ostream& out);

std::vector<Command> all_commands(const CommandLine& program) {
  std::vector<Command> all = {
      {"run", "run FILE.prm [--set \"Section/Entry=value\"]... [--output DIR] [--resume] [--dry-run]",
       "compute; `run` may be left out", run},
      {"geometry", "geometry FILE.prm [--set \"Section/Entry=value\"]... [--output DIR]",
       "write a metering device's walls (STL) and air mesh (Gmsh), to start a device of your own from",
       geometry},
      {"parameters", "parameters [SECTION]", "the reference of the parameter files", parameters},
      {"effects", "effects [NAME]", "the catalogue of physical effects", effects},
      {"bench", "bench [NAME]", "benchmarks, written to bench.json", bench},
      {"help", "help", "this text", help}};
  all.insert(all.end() - 1, program.commands.begin(), program.commands.end());
  return all;
}

int help(const CommandLine& program, const Arguments&, std::ostream& out) {
  if (program.rank != 0) return exit_done;
  for (const Command& command : all_commands(program))
    out << "  " << command.usage << "\n      " << command.description << "\n";
  if (!program.experiments.empty()) out << "\nExperiments:\n";
  for (const Experiment& experiment : program.experiments)
    out << "  " << std::left << std::setw(18) << experiment.name << ' ' << experiment.description << "\n";
  if (!program.benches.empty()) out << "\nBenchmarks:\n";
  for (const Bench& one : program.benches)
    out << "  " << std::left << std::setw(18) << one.name << ' ' << one.description << "\n";
  return exit_done;
}

}  // namespace

int CommandLine::execute(const std::vector<std::string>& arguments, std::ostream& out) const {
  if (arguments.empty() || arguments[0] == "--help" || arguments[0] == "-h") return help(*this, {}, out);
  Arguments rest(arguments.begin() + 1, arguments.end());
  if (is_parameter_file(arguments[0])) return run(*this, arguments, out);
  // Names of two words first: "bench diagnose" is a command of its own.
  if (!rest.empty())
    for (const Command& command : commands)
      if (command.name == arguments[0] + " " + rest[0])
        return command.execute(*this, Arguments(rest.begin() + 1, rest.end()), out);
  for (const Command& command : all_commands(*this))
    if (command.name == arguments[0]) return command.execute(*this, rest, out);
  std::vector<std::string> names = names_of(all_commands(*this));
  for (const char* name : {"test", "build"}) {
    if (arguments[0] == name)
      throw InputError("\"" + arguments[0] + "\" is a command of the launcher: ./seedflow " + arguments[0] +
                       ".");
    names.emplace_back(name);
  }
  throw InputError("command \"" + arguments[0] + "\" is not known. " +
                   suggestion(arguments[0], names, "command"));
}

}  // namespace seedflow
