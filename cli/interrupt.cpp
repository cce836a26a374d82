// SPDX-License-Identifier: Apache-2.0
#include "cli/interrupt.h"

#include <unistd.h>

#include <csignal>

#include "cli/context.h"

namespace cli {
namespace {

volatile std::sig_atomic_t stop_signal = 0;
void on_signal(int number) { stop_signal = number; }

}  // namespace

void catch_interrupts() {
  struct sigaction action {};
  action.sa_handler = on_signal;
  ::sigaction(SIGINT, &action, nullptr);
  ::sigaction(SIGTERM, &action, nullptr);
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

bool interrupt_requested() { return stop_signal != 0; }

void stop_on_interrupt(engine::RunOptions& options) {
  options.stop_requested = [] { return stop_signal != 0; };
  options.abandon = [] {
    // A task does not heed its stop request. The store is always in a state to be left.
    constexpr char text[] = "\ninterrupted: finished tasks are kept\n";
    if (::write(STDERR_FILENO, text, sizeof text - 1) < 0) ::_exit(interrupted);
    ::_exit(interrupted);
  };
}

}  // namespace cli
