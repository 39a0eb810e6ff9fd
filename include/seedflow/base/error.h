#pragma once

#include <stdexcept>
#include <string>

namespace seedflow {

/// What the process returns to the shell.
enum ExitStatus { exit_done = 0, exit_bad_input = 2, exit_failed = 3, exit_interrupted = 130 };

/// The user's input is wrong: what, where, what is allowed, what to do. Nothing has run yet. Exit status 2.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The computation failed: what, where, when, remedy. The state is saved by whoever catches it. Exit status 3.
class RunError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// SIGINT or SIGTERM arrived; the checkpoint is written by whoever catches it. Exit status 130.
class Interrupted : public std::runtime_error {
 public:
  Interrupted() : std::runtime_error("interrupted") {}
};

}  // namespace seedflow
