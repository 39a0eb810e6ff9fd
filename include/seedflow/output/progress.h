#pragma once

#include <functional>
#include <iosfwd>
#include <string>

namespace seedflow {

/// Shows how far a long computation is and how long it will still take. On a terminal one line is redrawn
/// several times a second; otherwise (a log file, a batch job) a plain line appears every few seconds, then
/// less and less often. Goes to stderr. Only rank 0 speaks.
///
/// The time left is (1 - f) / (f - f0) of the time since the start, f = now / end the fraction done and f0 =
/// start / end that at the start (> 0 after a resume).
class Progress {
 public:
  /// The quantity that grows, usually the simulated time [s], runs from zero to `end`; this run begins at
  /// `start`.
  Progress(const std::string& label, double end, double start = 0, int rank = 0);

  /// For tests and other places: where to write, whether it is a terminal, and the clock [s].
  struct Sink {
    std::ostream* stream = nullptr;
    bool terminal = false;
    std::function<double()> clock = nullptr;
    std::function<int()> columns =
        nullptr;  ///< width of the terminal in characters; longer lines are cut off
  };
  Progress(const std::string& label, double end, double start, Sink sink);

  /// Cheap enough to be called every step. `note`: a few words behind the time left ("v = 0.102 m/s").
  void update(double now, const std::string& note = "");
  /// Last line; the line on the terminal is closed with a line break.
  void finish(const std::string& note = "");
  /// Closes a half-drawn terminal line so that other output (an error) starts on a line of its own.
  ~Progress();

  /// "3 min 20 s", "2 h 05 min", "< 1 s".
  static std::string duration(double seconds);

 private:
  void print(double clock, const std::string& note, bool last);

  std::string label;
  double end, start;
  Sink sink;
  double start_time = 0, last_print = 0, interval = 0;
  double latest = 0;
  bool line_open = false, finished = false;
};

}  // namespace seedflow
