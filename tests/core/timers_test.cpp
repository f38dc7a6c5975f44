#include "core/timers.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

namespace lahar {
namespace {

TEST(Timers, ASectionIsFoundAgainUnderItsName) {
  Timers timers;
  Timers::Section& fluid = timers.section("fluid");
  fluid.seconds = 2;
  EXPECT_EQ(&timers.section("fluid"), &fluid);
  EXPECT_EQ(timers.section("particles").seconds, 0);
  EXPECT_EQ(timers.seconds().size(), 2u);
  EXPECT_EQ(timers.seconds().at("fluid"), 2);
}

TEST(Timers, AddressesStayValidWhenSectionsAreAdded) {
  Timers timers;
  Timers::Section* first = &timers.section("first");
  for (int i = 0; i < 1000; ++i) timers.section("section " + std::to_string(i));
  EXPECT_EQ(&timers.section("first"), first);
}

// steady_clock never runs backwards, so the sleep is a lower bound whatever the load of the machine.
TEST(ScopedTimer, AddsTheTimeOfEachScope) {
  Timers timers;
  auto& section = timers.section("sleep");
  for (int i = 0; i < 3; ++i) {
    const ScopedTimer timer(section);
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  EXPECT_GE(section.seconds, 0.015);
  const double before = section.seconds;
  std::this_thread::sleep_for(std::chrono::milliseconds(2));
  EXPECT_EQ(section.seconds, before);
}

}  // namespace
}  // namespace lahar
