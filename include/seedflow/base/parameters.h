#pragma once

#include <iosfwd>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "seedflow/base/error.h"
#include "seedflow/base/vector.h"

namespace seedflow {

/// The allowed values of a number, bounds included unless said otherwise.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_open = false;  ///< true: low itself is not allowed

  static Range any() { return {}; }
  static Range positive() { return {0.0, std::numeric_limits<double>::infinity(), true}; }
  static Range non_negative() { return {0.0, std::numeric_limits<double>::infinity(), false}; }
  static Range between(double a, double b) { return {a, b, false}; }
};

/// The entries of a .prm file. One call declares an entry, binds it to a variable, bounds it and documents
/// it: the variable's present value is the default, read() overwrites it (the variable must stay where it
/// is). A thin layer over dealii::ParameterHandler, which keeps the file format; this class adds units ("4
/// mm" is read as 0.004 for an entry in m; a bare number is in the entry's unit), bounds, names of the
/// nearest valid entry, file and line.
///
/// Errors: InputError with file, line, section, entry, value, what is allowed and the nearest valid name.
class Parameters {
 public:
  Parameters();
  ~Parameters();
  Parameters(Parameters&&) noexcept;
  Parameters& operator=(Parameters&&) noexcept;

  /// Declares inside a (nested) section for the lifetime of the returned object.
  class Section {
   public:
    Section(Parameters& p, const std::string& name, const std::string& doc) : parameters(p) {
      p.enter(name, doc);
    }
    ~Section() { parameters.leave(); }
    Section(const Section&) = delete;
    Section& operator=(const Section&) = delete;

   private:
    Parameters& parameters;
  };
  [[nodiscard]] Section section(const std::string& name, const std::string& doc = "") {
    return {*this, name, doc};
  }

  /// `unit` is SI ("m", "kg/m3", "Pa s", "1" for none).
  void number(const std::string& name, double& target, const std::string& unit, Range range,
              const std::string& doc);
  void integer(const std::string& name, int& target, Range range, const std::string& doc);
  void flag(const std::string& name, bool& target, const std::string& doc);
  void choice(const std::string& name, std::string& target, const std::vector<std::string>& options,
              const std::string& doc);
  void text(const std::string& name, std::string& target, const std::string& doc);
  void vector(const std::string& name, Vec3& target, const std::string& unit, Range range,
              const std::string& doc);
  /// Comma-separated lists.
  void numbers(const std::string& name, std::vector<double>& target, const std::string& unit, Range range,
               const std::string& doc);
  void texts(const std::string& name, std::vector<std::string>& target, const std::string& doc);
  /// The name of a file to read, or "" for none. A relative name is relative to the file it is written in (to
  /// the working directory after --set); `target` and used.prm hold the absolute name.
  void file(const std::string& name, std::string& target, const std::string& doc);
  /// A comma-separated list whose members must be among the options.
  void choices(const std::string& name, std::vector<std::string>& target,
               const std::vector<std::string>& options, const std::string& doc);

  /// Reads a file and then overrides of the form "Section/Subsection/Entry=value", and fills every bound
  /// variable; entries that are not set get their defaults again. All mistakes found are listed in one
  /// InputError. An entry may be set once per file; a file may set again what a file it includes has set.
  void read(const std::string& file, const std::vector<std::string>& overrides = {});

  /// The complete, re-runnable file with every entry, its documentation, unit and bounds as comments. Numbers
  /// are written so that the same double is read back.
  void write(std::ostream& out) const;
  /// The generated reference of one section ("" = all) as plain text.
  void describe(std::ostream& out, const std::string& section = "") const;

  /// A cross-check between entries failed: throws InputError naming the file, line and value of `path`
  /// ("Section/Entry"), the reason and the remedy.
  [[noreturn]] void reject(const std::string& path, const std::string& reason,
                           const std::string& remedy) const;

  /// Whether the file or an override sets the entry (otherwise it has its default).
  bool is_set(const std::string& path) const;
  /// The present value of an entry as text; InputError with the nearest valid path if there is none.
  std::string value(const std::string& path) const;
  /// The unit an entry was declared with.
  std::string unit(const std::string& path) const;
  /// A file name given in a .prm, relative to the .prm's own folder unless absolute.
  std::string resolve(const std::string& file_name) const;

 private:
  void enter(const std::string& name, const std::string& doc);
  void leave();
  struct Implementation;
  std::unique_ptr<Implementation> implementation;
};

}  // namespace seedflow
