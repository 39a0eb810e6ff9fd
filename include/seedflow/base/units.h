#pragma once

#include <array>
#include <string>
#include <vector>

namespace seedflow {

/// A unit of measurement: value_SI = (value * factor) * 10^exponent + offset.
/// The power of ten is kept apart so that "0.3 mm" is read as exactly the double nearest to 0.0003.
struct Unit {
  /// Exponents of length, mass, time, temperature and plane angle. The angle is a dimension of its own, so
  /// that rad/s is not mistaken for 1/s.
  std::array<int, 5> dimension{};
  double factor = 1;
  int exponent = 0;
  double offset = 0;  ///< only "degC" alone
};

/// Reads a unit: products by a space or '*', powers as "m2" or "m^2" or "s-1", '/' for the factor that
/// follows it
/// ("kg/m3", "mPa s", "J/(kg K)", "rpm", "%", "1" for none). SI prefixes n, u, m, c, k, M, G go with m, g, s,
/// N, Pa, J, W, Hz and L. Throws InputError for an unknown name or an ambiguous quotient ("N/m s").
Unit parse_unit(const std::string& text);

/// Reads "4 mm", "-3 kPa", "0.004" against the SI unit of an entry; a bare number is in that unit.
/// Throws InputError: not a finite number, unknown unit, or a unit of another dimension (naming accepted
/// ones).
double to_si(const std::string& text, const std::string& si_unit);

/// Splits "1 mm" into {"1", "mm"}, "5" into {"5", ""}. Throws InputError if it does not begin with a number.
struct NumberWithUnit {
  std::string number, unit;
};
NumberWithUnit split_unit(const std::string& text);

/// Units which a user may write for an entry in `si_unit`, that one first.
std::vector<std::string> accepted_units(const std::string& si_unit);

/// The shortest decimal text that is read back as the same double.
std::string exact_text(double value);

}  // namespace seedflow
