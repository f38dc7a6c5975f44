#include "core/archive.h"

#include <gtest/gtest.h>

#include <limits>

#include "core/memory_archive.h"
#include "core/timers.h"

namespace lahar {
namespace {

enum class Colour : std::uint8_t { red, green };

struct Inner {
  bool on = false;
  Vec3 place = Vec3::Zero();
  void transfer(Archive& archive) {
    archive.value("on", on);
    archive.value("place", place);
  }
};

struct Everything {
  std::int64_t steps = 0;
  std::uint64_t birth = 0;
  float share = 0;
  Colour colour = Colour::red;
  std::vector<double> numbers;
  std::vector<Colour> colours;
  std::vector<Vec3> places;
  Vec3Field field;
  std::string text;
  std::map<std::string, double> found;
  std::vector<std::vector<float>> blocks;
  Inner inner;

  void transfer(Archive& archive) {
    archive.value("steps", steps);
    archive.value("birth", birth);
    archive.value("share", share);
    archive.value("colour", colour);
    archive.list("numbers", numbers);
    archive.list("colours", colours);
    archive.list("places", places);
    archive.list("field", field);
    archive.text("text", text);
    archive.numbers("found", found);
    archive.pieces<float>("blocks", blocks.size(), 300, [&](std::size_t k, float* buffer) {
      if (archive.loading())
        blocks[k].assign(buffer, buffer + 300);
      else
        std::copy(blocks[k].begin(), blocks[k].end(), buffer);
    });
    archive.part("inner", inner);
  }
};

Everything filled() {
  Everything e;
  e.steps = -7, e.birth = ~std::uint64_t{0}, e.share = 0.1F, e.colour = Colour::green;
  e.numbers = {1, -0.0, std::numeric_limits<double>::denorm_min(), std::numeric_limits<double>::infinity()};
  e.colours = {Colour::green, Colour::red};
  e.places = {{1, 2, 3}, {4, 5, 6}};
  e.field.push_back({7, 8, 9});
  e.text = "two\nlines";
  e.found = {{"peak_kN", 3.5}, {"time_s", 0.25}};
  e.blocks.assign(10000, std::vector<float>(300));  // more than fits into one buffer
  for (std::size_t k = 0; k < e.blocks.size(); ++k) e.blocks[k][k % 300] = static_cast<float>(k);
  e.inner = {true, {0, 1, 2}};
  return e;
}

TEST(Archive, WhatComesBackIsWhatWentIn) {
  Everything e = filled();
  StoredState state = state_of(e);
  Everything back;
  back.blocks.resize(e.blocks.size());
  load_state(state, back);
  EXPECT_TRUE(differing_lists(state, state_of(back)).empty());
  EXPECT_EQ(back.steps, -7);
  EXPECT_EQ(back.birth, ~std::uint64_t{0});
  EXPECT_EQ(back.colour, Colour::green);
  EXPECT_TRUE(std::signbit(back.numbers[1]));
  EXPECT_EQ(back.places[1], Vec3(4, 5, 6));
  EXPECT_EQ(back.text, "two\nlines");
  EXPECT_EQ(back.found, e.found);
  EXPECT_EQ(back.blocks, e.blocks);
  EXPECT_TRUE(back.inner.on);
}

TEST(Archive, DifferencesAreNamed) {
  Everything e = filled();
  const StoredState before = state_of(e);
  e.inner.place.y() += 1e-15;
  e.numbers.push_back(0);
  EXPECT_EQ(differing_lists(before, state_of(e)), (std::vector<std::string>{"inner/place", "numbers"}));
}

TEST(Archive, RefusesWhatDoesNotFit) {
  Everything e = filled(), back;
  StoredState state = state_of(e);
  EXPECT_THROW(load_state(state, back), ArchiveError);  // no place for the blocks
  state.lists.erase("steps");
  try {
    load_state(state, e);
    FAIL() << "steps are missing";
  } catch (const ArchiveError& error) {
    EXPECT_STREQ(error.what(), "steps is missing");
  }
  StoredState wrong = state_of(e);
  wrong.lists["share"] = wrong.lists["steps"];
  EXPECT_THROW(load_state(wrong, e), ArchiveError);
}

TEST(Archive, TimersGoOn) {
  Timers timers, later;
  timers.section("a").seconds = 2;
  StoredState state = state_of(timers);
  later.section("b").seconds = 1;
  load_state(state, later);
  EXPECT_EQ(later.seconds(), (std::map<std::string, double>{{"a", 2}, {"b", 1}}));
}

}  // namespace
}  // namespace lahar
