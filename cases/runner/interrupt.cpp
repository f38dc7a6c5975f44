#include "cases/runner/interrupt.h"

#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <ctime>

#include "cases/runner/options.h"

namespace lahar::cases {
namespace {

bool watching = false;
std::atomic<const char*> more_to_say{nullptr};
std::atomic<std::int64_t> first_signal_ms{0};  // 0: none has come
static_assert(std::atomic<std::int64_t>::is_always_lock_free,
              "only lock-free atomics may be touched in a signal handler");

constexpr std::int64_t kOneRequestMs = 1000;

std::int64_t now_ms() {
  timespec t{};
  clock_gettime(CLOCK_MONOTONIC, &t);  // may be called in a signal handler (POSIX)
  return std::int64_t{1000} * t.tv_sec + t.tv_nsec / 1000000;
}

/// Programs that end others often signal the process and its group: two signals within a moment are one request. The
/// second one may come amid this function.
void note(int signal) {
  const std::int64_t now = std::max<std::int64_t>(1, now_ms());
  std::int64_t first = 0;
  if (!first_signal_ms.compare_exchange_strong(first, now) && now - first > kOneRequestMs) {
    std::signal(signal, SIG_DFL);
    std::raise(signal);
  }
}

void end(int) {
  static constexpr char kText[] = "interrupted before the run began\n";
  [[maybe_unused]] auto written = write(STDERR_FILENO, kText, sizeof kText - 1);
  if (const char* const more = more_to_say.load()) written = write(STDERR_FILENO, more, std::strlen(more));
  _exit(exit_interrupted);
}

void set_handler(void (*handler)(int)) {
  struct sigaction action {};
  action.sa_handler = handler;
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  struct sigaction hangup {};
  sigaction(SIGHUP, nullptr, &hangup);
  if (hangup.sa_handler != SIG_IGN) sigaction(SIGHUP, &action, nullptr);
}

}  // namespace

void say_at_interrupt(const char* more) { more_to_say.store(more); }

void end_at_interrupt() {
  watching = false;
  set_handler(end);
  std::signal(SIGXFSZ, SIG_IGN);
}

void watch_for_interrupt() {
  if (watching) return;
  watching = true;
  first_signal_ms.store(0);
  set_handler(note);
  std::signal(SIGPIPE, SIG_IGN);
}

bool interrupted() { return first_signal_ms.load(std::memory_order_relaxed) != 0; }

}  // namespace lahar::cases
