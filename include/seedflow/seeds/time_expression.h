#pragma once

#include <memory>
#include <string>

namespace seedflow {

/// A function of the time t [s] as text in the language of muParser ("0.01 * sin(2*pi*50*t)", also
/// "t < 1 ? 0 : (t - 1)"). Knows pi.
///
/// Errors: InputError for a text that does not read; RunError for a value that is not finite.
class TimeExpression {
 public:
  explicit TimeExpression(const std::string& text);
  ~TimeExpression();

  double value(double t) const;
  /// Its derivative by central differences of fourth order with a step of 1 us, so a kink is smoothed over
  /// 4 us.
  double rate(double t) const;
  const std::string& text() const { return written; }

 private:
  struct Implementation;
  std::string written;
  std::unique_ptr<Implementation> implementation;
};

}  // namespace seedflow
