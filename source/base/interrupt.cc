#include "seedflow/base/interrupt.h"

#include <signal.h>
#include <unistd.h>

#include <array>

namespace seedflow {
namespace {

constexpr std::array<int, 3> signals = {SIGINT, SIGTERM, SIGUSR1};

volatile sig_atomic_t arrived = 0;
volatile sig_atomic_t speaks = 0;
int guards = 0;
std::array<struct sigaction, signals.size()> previous;

extern "C" void note_signal(int) {
  if (arrived) return;
  arrived = 1;
  if (!speaks) return;
  static const char text[] = "\nInterrupt received: the present step is finished first.\n";
  // write() is the only output a handler may do; if it fails there is nobody left to tell.
  [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, text, sizeof text - 1);
}

}  // namespace

InterruptGuard::InterruptGuard(MPI_Comm communicator) : communicator(communicator) {
  if (guards++ > 0) return;
  int rank = 0;
  MPI_Comm_rank(communicator, &rank);
  arrived = 0;
  speaks = rank == 0;
  struct sigaction action {};
  action.sa_handler = note_signal;
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  for (std::size_t i = 0; i < signals.size(); ++i) sigaction(signals[i], &action, &previous[i]);
}

InterruptGuard::~InterruptGuard() {
  if (--guards > 0) return;
  for (std::size_t i = 0; i < signals.size(); ++i) sigaction(signals[i], &previous[i], nullptr);
}

bool InterruptGuard::requested() const {
  const int mine = arrived;
  int any = 0;
  MPI_Allreduce(&mine, &any, 1, MPI_INT, MPI_MAX, communicator);
  return any != 0;
}

void InterruptGuard::check() const {
  if (requested()) throw Interrupted();
}

}  // namespace seedflow
