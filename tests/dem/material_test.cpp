#include "dem/material.h"

#include <gtest/gtest.h>

#include <utility>

namespace lahar::dem {
namespace {

/// Rock on steel: worked out by hand.
TEST(Materials, ModuliOfAPair) {
  Materials m;
  m.add({"rock", 10e9, 0.3});
  m.add({"steel", 70e9, 0.2});
  for (const auto& [a, b] : {std::pair(0, 1), std::pair(1, 0)}) {
    EXPECT_NEAR(m.pair(a, b).effective_modulus, 9.549795e9, 1e3);
    EXPECT_NEAR(m.pair(a, b).effective_shear_modulus, 1.985252e9, 1e3);
  }
  EXPECT_NEAR(m.pair(0, 0).effective_modulus, 10e9 / (2 * 0.91), 1);
  EXPECT_NEAR(m.pair(1, 1).effective_modulus, 70e9 / (2 * 0.96), 1);
}

TEST(Materials, PairsStayAsMoreAreAdded) {
  Materials m;
  for (const auto* name : {"a", "b"}) m.add({name, 1e9, 0.25});
  m.set_pair(0, 0, 0.1, 0.9), m.set_pair(0, 1, 0.4, 0.5, 0.05), m.set_pair(1, 1, 0.9, 0.3);
  m.add({"c", 5e9, 0.2});
  EXPECT_EQ(m.pair(0, 0).friction, 0.1);
  EXPECT_EQ(m.pair(1, 1).restitution, 0.3);
  for (const auto& [a, b] : {std::pair(0, 1), std::pair(1, 0)}) {
    EXPECT_EQ(m.pair(a, b).friction, 0.4);
    EXPECT_EQ(m.pair(a, b).restitution, 0.5);
    EXPECT_EQ(m.pair(a, b).rolling_friction, 0.05);
  }
  EXPECT_EQ(m.pair(2, 1).friction, 0);
  EXPECT_EQ(m.pair(2, 1).restitution, 1);
}

}  // namespace
}  // namespace lahar::dem
