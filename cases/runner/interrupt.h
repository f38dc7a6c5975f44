#pragma once
// Ctrl-C and SIGTERM end a run at its next step, with its files whole, and a program that has not begun one at once.

namespace lahar::cases {

/// From now on SIGINT and SIGTERM end the process at once, with exit_interrupted: there is nothing to finish yet.
void end_at_interrupt();

/// From now on the first SIGINT or SIGTERM only sets a flag; one that comes more than a second later ends the process
/// at once. Changes nothing where this is so already.
void watch_for_interrupt();

/// Whether such a signal came. Safe to ask from any thread.
bool interrupted();

}  // namespace lahar::cases
