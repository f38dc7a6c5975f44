#include "cases/runner/interrupt.h"

#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <thread>

namespace lahar::cases {
namespace {

TEST(Interrupt, TheFirstSignalSetsTheFlag) {
  std::signal(SIGHUP, SIG_DFL);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    end_at_interrupt();
    watch_for_interrupt();
    EXPECT_FALSE(interrupted());
    std::raise(signal);
    EXPECT_TRUE(interrupted());
    watch_for_interrupt();
    EXPECT_TRUE(interrupted());
  }
  end_at_interrupt();
  watch_for_interrupt();
  EXPECT_FALSE(interrupted());
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
  std::signal(SIGHUP, SIG_DFL);
  std::signal(SIGPIPE, SIG_DFL);
}

TEST(InterruptDeathTest, BeforeARunASignalEndsTheProcess) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP})
    EXPECT_EXIT(
        {
          std::signal(SIGHUP, SIG_DFL);
          end_at_interrupt();
          std::raise(signal);
        },
        testing::ExitedWithCode(130), "interrupted before the run began");
}

TEST(InterruptDeathTest, ASecondSignalEndsTheProcess) {
  EXPECT_EXIT(
      {
        watch_for_interrupt();
        std::raise(SIGINT);
        std::this_thread::sleep_for(std::chrono::milliseconds(1100));
        std::raise(SIGINT);
      },
      testing::KilledBySignal(SIGINT), "");
}

/// As nohup starts them.
TEST(InterruptDeathTest, ARunThatIsToOutliveItsTerminalDoes) {
  EXPECT_EXIT(
      {
        std::signal(SIGHUP, SIG_IGN);
        end_at_interrupt();
        watch_for_interrupt();
        std::raise(SIGHUP);
        std::_Exit(interrupted() ? 7 : 8);
      },
      testing::ExitedWithCode(8), "");
}

TEST(InterruptDeathTest, ARunGoesOnWhenNobodyReadsWhatItPrints) {
  EXPECT_EXIT(
      {
        watch_for_interrupt();
        std::raise(SIGPIPE);
        std::_Exit(interrupted() ? 7 : 8);
      },
      testing::ExitedWithCode(8), "");
}

TEST(InterruptDeathTest, TwoSignalsAtOnceAreOneRequest) {
  EXPECT_EXIT(
      {
        watch_for_interrupt();
        std::raise(SIGTERM);
        std::raise(SIGTERM);
        std::_Exit(interrupted() ? 7 : 8);
      },
      testing::ExitedWithCode(7), "");
}

}  // namespace
}  // namespace lahar::cases
