#pragma once
// Ctrl-C and SIGTERM end a run at its next step, with its files whole.

namespace lahar::cases {

/// From now on the first SIGINT or SIGTERM only sets a flag; one that comes more than a second later
/// ends the process at once.
void watch_for_interrupt();

/// Whether such a signal came. Safe to ask from any thread.
bool interrupted();

}  // namespace lahar::cases
