#include "cases/runner/interrupt.h"

#include <atomic>
#include <csignal>

namespace lahar::cases {
namespace {

std::atomic<bool> flag{false};
static_assert(std::atomic<bool>::is_always_lock_free, "only lock-free atomics may be touched in a signal handler");

void note(int) { flag.store(true); }

}  // namespace

void watch_for_interrupt() {
  struct sigaction action {};
  action.sa_handler = note;
  // Back to the default action after the first signal, so that a second one is not ignored.
  action.sa_flags = static_cast<int>(SA_RESETHAND) | SA_RESTART;
  sigemptyset(&action.sa_mask);
  flag.store(false);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

bool interrupted() { return flag.load(std::memory_order_relaxed); }

}  // namespace lahar::cases
