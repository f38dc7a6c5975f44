#include "cases/scene/names.h"

#include <gtest/gtest.h>

#include <set>

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

/// Every value of an option has a word of its own that leads back to it.
template <class E>
void expect_words(E) {
  std::set<std::string_view> words;
  for (const auto& choice : choices(E{})) {
    EXPECT_EQ(name_of(choice.value), choice.word);
    EXPECT_TRUE(words.insert(choice.word).second) << choice.word;
  }
}

struct Round {
  static constexpr std::string_view name = "round", meaning = "without corners";
};
struct Square {
  static constexpr std::string_view name = "square", meaning = "with four";
  double side = 2;
};

/// Types that stand in a variant are options without a line here, whatever their members are.
TEST(Names, TypesInAVariantNameThemselves) {
  const auto all = choices(std::variant<Round, Square>{});
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[1].word, "square");
  EXPECT_EQ(all[1].meaning, "with four");
  EXPECT_EQ(std::get<Square>(all[1].value).side, 2);
  EXPECT_EQ(name_of(std::variant<Round, Square>{Square{7}}), "square");
}

TEST(Names, EveryOptionHasAWordThatLeadsBack) {
  expect_words(CollisionOperator{}), expect_words(BodyWeighting{}), expect_words(SolidOperator{});
  expect_words(WallPlacement{}), expect_words(FlowLaw{}), expect_words(WireContacts{}), expect_words(FootJoint{});
  expect_words(SizeWeight{}), expect_words(Face{}), expect_words(ContactLaw{});
  EXPECT_EQ(name_of(Precision::float64), "double");
}

}  // namespace
}  // namespace lahar::scene
