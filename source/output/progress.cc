#include "seedflow/output/progress.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <iostream>

namespace seedflow {

namespace {

double steady_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

int terminal_columns() {
  winsize size{};
  return ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 ? size.ws_col : 0;
}

/// The first `n` characters (not bytes) of UTF-8 text.
std::string first_characters(const std::string& text, int n) {
  std::size_t end = 0;
  for (int seen = 0; end < text.size(); ++end)
    if ((static_cast<unsigned char>(text[end]) & 0xC0) != 0x80 && ++seen > n) break;
  return text.substr(0, end);
}

constexpr double redraw_interval = 0.25;      // [s] on a terminal
constexpr double first_line_interval = 5;     // [s] between plain lines ...
constexpr double line_interval_growth = 1.5;  // ... growing, so that a log of a day stays short
constexpr double last_line_interval = 300;

}  // namespace

Progress::Progress(const std::string& label, double end, double start, int rank)
    : Progress(label, end, start,
               Sink{rank == 0 ? &std::cerr : nullptr, rank == 0 && ::isatty(STDERR_FILENO) == 1,
                    steady_seconds, terminal_columns}) {}

Progress::Progress(const std::string& label_, double end_, double start_, Sink sink_)
    : label(label_), end(end_), start(start_), sink(std::move(sink_)), latest(start_) {
  if (!sink.stream) return;
  start_time = last_print = sink.clock();
  interval = sink.terminal ? redraw_interval : first_line_interval;
}

Progress::~Progress() {
  if (line_open) *sink.stream << std::endl;
}

std::string Progress::duration(double seconds) {
  if (!(seconds < 1e9)) return "unknown";
  if (seconds < 1) return "< 1 s";
  char text[64];
  const long s = std::lround(seconds);
  if (s < 60)
    std::snprintf(text, sizeof text, "%ld s", s);
  else if (s < 3600)
    std::snprintf(text, sizeof text, "%ld min %02ld s", s / 60, s % 60);
  else if (s < 100 * 3600)
    std::snprintf(text, sizeof text, "%ld h %02ld min", s / 3600, s % 3600 / 60);
  else
    std::snprintf(text, sizeof text, "%ld days %ld h", s / 86400, s % 86400 / 3600);
  return text;
}

void Progress::update(double now, const std::string& note) {
  latest = now;
  if (!sink.stream || finished) return;
  const double clock = sink.clock();
  if (clock - last_print < interval) return;
  last_print = clock;
  print(clock, note, false);
  if (!sink.terminal) interval = std::min(interval * line_interval_growth, last_line_interval);
}

void Progress::finish(const std::string& note) {
  if (!sink.stream || finished) return;
  finished = true;
  print(sink.clock(), note, true);
}

void Progress::print(double clock, const std::string& note, bool last) {
  const double done = end > 0 ? std::clamp(latest / end, 0.0, 1.0) : 1.0;
  const double done_here = end > 0 ? (latest - start) / end : 1.0;
  const double elapsed = clock - start_time;
  char text[160];
  if (last)
    std::snprintf(text, sizeof text, "%3.0f %%  took %s", 100 * done, duration(elapsed).c_str());
  else if (done_here > 0)
    std::snprintf(text, sizeof text, "%3.0f %%  %s left", 100 * done,
                  duration(elapsed * (1 - done) / done_here).c_str());
  else
    std::snprintf(text, sizeof text, "%3.0f %%", 100 * done);
  std::string line = label + " " + text + (note.empty() ? "" : "  " + note);
  if (sink.terminal) {
    // A line that wraps could not be redrawn. Zero columns: unknown.
    if (const int columns = sink.columns ? sink.columns() : 0; columns > 1 && !last)
      line = first_characters(line, columns - 1);
    *sink.stream << "\r\033[K" << line << (last ? "\n" : "") << std::flush;
    line_open = !last;
  } else {
    *sink.stream << line << std::endl;
  }
}

}  // namespace seedflow
