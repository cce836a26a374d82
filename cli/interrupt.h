// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "engine/run/run.h"

namespace cli {

// From here on Ctrl-C and SIGTERM ask for a stop instead of ending the process.
void catch_interrupts();
bool interrupt_requested();
// Has a run end at the request, and the process soon after it where a task does not heed it.
void stop_on_interrupt(engine::RunOptions& options);

}  // namespace cli
