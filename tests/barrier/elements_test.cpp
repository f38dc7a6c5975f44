#include "barrier/elements.h"

#include <gtest/gtest.h>

#include <set>
#include <vector>

#include "barrier/response.h"

namespace lahar::barrier {
namespace {

struct Flag {
  static constexpr std::string_view component = "flags";
  int number = 0;
  bool operator==(const Flag&) const = default;
};
struct Lamp {
  static constexpr std::string_view component = "lamps";
  double height = 0;
  bool operator==(const Lamp&) const = default;
};

TEST(Elements, AreListedByKindInTheOrderOfTheKinds) {
  ElementLists<Flag, Lamp> all;
  all.of<Flag>() = {{1}, {2}};
  all.of<Lamp>() = {{3.5}};
  std::vector<std::size_t> kinds, counts;
  all.for_each_kind([&](const auto& list, std::size_t kind) { kinds.push_back(kind), counts.push_back(list.size()); });
  EXPECT_EQ(kinds, (std::vector<std::size_t>{0, 1}));
  EXPECT_EQ(counts, (std::vector<std::size_t>{2, 1}));
  EXPECT_EQ(all.components[1], "lamps");
  ElementLists<Flag, Lamp> other = all;
  EXPECT_EQ(all, other);
  other.of<Flag>().pop_back();
  EXPECT_NE(all, other);
}

TEST(Elements, AreComponentsOfTheResponseWithNamesOfTheirOwn) {
  std::set<std::string_view> names;
  for (const Component c : all_components) EXPECT_TRUE(names.insert(name(c)).second) << name(c);
  EXPECT_EQ(name(component_of_kind(0)), RetainingCable::component);
  EXPECT_EQ(names.size(), 8 + Elements::components.size());
  EXPECT_FALSE(is_reported(component_of_kind(0), Net{}));
}

}  // namespace
}  // namespace lahar::barrier
