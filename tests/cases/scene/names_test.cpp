#include "cases/scene/names.h"

#include <gtest/gtest.h>

namespace lahar::scene {
namespace {

TEST(EditDistance, KnownPairs) {
  EXPECT_EQ(edit_distance("", ""), 0);
  EXPECT_EQ(edit_distance("", "abc"), 3);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3);
  EXPECT_EQ(edit_distance("durtaion", "duration"), 1);  // neighbours swapped
  EXPECT_EQ(edit_distance("lahar", "lahar"), 0);
}

TEST(NearestName, FindsTypingErrorsAndMissingUnits) {
  const std::vector<std::string> known{"cell_size_m", "density_kg_m3", "kinematic_viscosity_m2_s"};
  EXPECT_EQ(nearest_name("cell_szie_m", known), "cell_size_m");
  EXPECT_EQ(nearest_name("kinematic_viscosity", known), "kinematic_viscosity_m2_s");
  EXPECT_EQ(nearest_name("density", known), "density_kg_m3");
}

TEST(NearestName, SuggestsNothingForAStranger) {
  EXPECT_EQ(nearest_name("colour", {"cell_size_m", "density_kg_m3"}), "");
  EXPECT_EQ(nearest_name("x", {}), "");
}

TEST(Names, EveryOptionHasAWordThatLeadsBack) {
  for (const auto& [name, value] : names_of(Collision{})) EXPECT_EQ(name_of(value), name);
  for (const auto& [name, value] : names_of(Face{})) EXPECT_EQ(name_of(value), name);
  EXPECT_EQ(name_of(Precision::float64), "double");
}

}  // namespace
}  // namespace lahar::scene
