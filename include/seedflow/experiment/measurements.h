#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace seedflow {

/// One measured value.
struct Measurement {
  std::string condition;       ///< name of the condition it was taken under
  std::string quantity, unit;  ///< an observable of the experiment
  double coordinate = 0;       ///< time, position, ...; NaN if the quantity has none
  std::string coordinate_unit;
  double value = 0;
  double standard_uncertainty = 0;
  int line = 0;                       ///< of the file
  double correlated_uncertainty = 0;  ///< the part that neighbours share [correlated_unit], beside the above
  double correlation_length = 0;      ///< [correlated_coordinate_unit]
  std::string correlated_unit = "", correlated_coordinate_unit = "";
  std::string file = "", correlated_where = "";  ///< the file; "file:line" of the correlated part

  /// "file:line"
  std::string where() const;
};

/// One set of conditions: what differs from the base .prm.
struct Condition {
  std::string name;
  bool held_out = false;
  std::vector<std::string> overrides;  ///< "Section/Entry=value unit"
  std::string where = "";              ///< "file:line"
};

/// Reads `condition,quantity,unit,coordinate,coordinate_unit,value,standard_uncertainty`, in any order; see
/// CsvRows. The columns of the coordinate may be missing where no quantity has one. An uncertainty may be
/// written as a percentage of the value, "2 %". A comment `#
/// correlated,QUANTITY,UNIT,UNCERTAINTY,COORDINATE_UNIT,LENGTH` gives all values of a quantity a further
/// standard uncertainty that neighbours share, with correlation exp(-distance/LENGTH); LENGTH may be inf. Its
/// units are its own.
/// Errors: InputError with file and line for a missing column, a number that is none, not finite, a missing
/// unit, an uncertainty that is not positive, a point given twice.
std::vector<Measurement> read_measurements(const std::filesystem::path& file);

/// Reads `condition,held_out,` and one column per entry that differs, named `Section/Entry [unit]`; held_out
/// is yes or no, and no if missing. Where a field is empty, the entry stays as in the base .prm. Errors:
/// InputError with file and line.
std::vector<Condition> read_conditions(const std::filesystem::path& file);

}  // namespace seedflow
