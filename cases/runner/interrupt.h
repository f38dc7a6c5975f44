#pragma once
// Ctrl-C, SIGTERM and the end of the terminal (SIGHUP) end a run at its next step, with its files whole, and a program
// that has not begun one at once. A process that was started to outlive its terminal (nohup) does so.

namespace lahar::cases {

/// From now on SIGINT, SIGTERM and SIGHUP end the process at once, with exit_interrupted: there is nothing to finish
/// yet. SIGXFSZ is ignored: a file that gets larger than the shell allows (ulimit -f) is a write that fails and says
/// so.
void end_at_interrupt();

/// What the end at such a signal says beside that there was one; null: no more. A text that stays.
void say_at_interrupt(const char* more);

/// From now on the first SIGINT, SIGTERM or SIGHUP only sets a flag; one that comes more than a second later ends the
/// process at once. SIGPIPE is ignored: a run goes on when nobody reads what it prints. Changes nothing where this is
/// so already.
void watch_for_interrupt();

/// Whether such a signal came. Safe to ask from any thread.
bool interrupted();

}  // namespace lahar::cases
