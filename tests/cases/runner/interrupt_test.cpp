#include "cases/runner/interrupt.h"

#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <thread>

namespace lahar::cases {
namespace {

TEST(Interrupt, TheFirstSignalSetsTheFlag) {
  for (const int signal : {SIGINT, SIGTERM}) {
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
}

TEST(InterruptDeathTest, BeforeARunASignalEndsTheProcess) {
  for (const int signal : {SIGINT, SIGTERM})
    EXPECT_EXIT(
        {
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
