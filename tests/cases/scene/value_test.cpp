#include "cases/scene/value.h"

#include <gtest/gtest.h>

namespace lahar::scene {
namespace {

template <class T>
std::string read_text(const std::string& text, T& value, const Rule& rule = {}) {
  const toml::table table = toml::parse("v = " + text);
  return read(*table.get("v"), rule, value);
}

TEST(Value, NumbersReadBackExactly) {
  for (const double number : {0.0, -0.0, 1.0, 0.1, 1e-6, 1.0 / 3.0, 6.02214076e23, 1e-30, 1e30}) {
    double back = 7;
    EXPECT_EQ(read_text(number_text(number), back), "");
    EXPECT_EQ(back, number) << number_text(number);
  }
}

TEST(Value, NumbersBeyondSenseAreRefused) {
  for (const double number : {5e-324, -1e-31, 1.1e30, 1.7976931348623157e308}) {
    double back = 7;
    EXPECT_NE(read_text(number_text(number), back).find("makes sense in no unit"), std::string::npos) << number;
    EXPECT_EQ(back, 7);
  }
}

TEST(Value, StringsReadBackExactly) {
  for (const std::string text :
       {"", "plain", "quo\"te", "back\\slash", "line\nbreak\ttab\x01", "Gerinne \xc3\xbc", "\xc2\x85 \xc2\x9b[31m"}) {
    std::string back;
    EXPECT_EQ(read_text(string_text(text), back), "");
    EXPECT_EQ(back, text);
  }
}

TEST(Value, StringsAreWrittenWithoutControlCharacters) {
  EXPECT_EQ(string_text("\"\\\n\x7f\xc2\x9b[31m\xc3\xbc"), "\"\\\"\\\\\\u000A\\u007F\\u009B[31m\xc3\xbc\"");
}

/// As in names of files, which are any bytes.
TEST(Value, OnlyUtf8FitsInToml) {
  for (const std::string text : {"", "quo\"te", "line\nbreak", "Gerinne \xc3\xbc"})
    EXPECT_TRUE(fits_in_toml(text)) << text;
  for (const std::string text : {"Gerinne \xfc", "\xc3", "\xed\xa0\x80"}) EXPECT_FALSE(fits_in_toml(text)) << text;
}

/// Whole numbers beyond 2^53, too, are numbers.
TEST(Value, ReadsLargeWholeNumbers) {
  double number = 7;
  EXPECT_EQ(read_text("10000000000000000", number), "");
  EXPECT_EQ(number, 1e16);
  Vec3 vector;
  EXPECT_EQ(read_text("[1, -20000000000000000, 3]", vector), "");
  EXPECT_EQ(vector.y(), -2e16);
}

TEST(Value, RefusesWhatIsNotFinite) {
  double number = 7;
  EXPECT_EQ(read_text("inf", number), "is inf");
  EXPECT_EQ(read_text("-inf", number), "is -inf");
  EXPECT_EQ(read_text("nan", number), "is nan");
  Vec3 vector;
  EXPECT_EQ(read_text("[0, nan, 0]", vector), "has entry 2, which is nan");
  EXPECT_EQ(number, 7);
}

TEST(Value, RefusesOtherTypes) {
  double number = 7;
  std::int64_t whole = 7;
  bool flag = true;
  std::string text;
  Vec3 vector;
  EXPECT_EQ(read_text("\"1\"", number), "is a string");
  EXPECT_EQ(read_text("2020-01-01", number), "is a date or time");
  EXPECT_EQ(read_text("1.0", whole), "is 1.0");
  EXPECT_EQ(read_text("1", flag), "is 1");
  EXPECT_EQ(read_text("true", text), "is true or false");
  EXPECT_EQ(read_text("1.0", vector), "is a number");
  EXPECT_EQ(read_text("[1, 2]", vector), "has 2 entries");
  EXPECT_EQ(read_text("[1, 2, \"x\"]", vector), "has entry 3, which is a string");
}

TEST(Value, TakesWholeNumbersForNumbers) {
  double number = 0;
  EXPECT_EQ(read_text("3", number), "");
  EXPECT_EQ(number, 3.0);
}

TEST(Value, ListsObeyTheirLengths) {
  std::vector<double> list;
  const Rule rule{.range = positive(), .min_count = 1, .max_count = 2};
  EXPECT_EQ(read_text("[1, 2]", list, rule), "");
  EXPECT_EQ(list, (std::vector<double>{1, 2}));
  EXPECT_EQ(read_text("[]", list, rule), "has 0 entries");
  EXPECT_EQ(read_text("[1, 2, 3]", list, rule), "has 3 entries");
  EXPECT_EQ(read_text("[1, -2]", list, rule), "has entry 2, which is -2");
}

TEST(Value, SuggestsTheNearestWordOfAnOption) {
  CollisionOperator collision = lbm::Trt{};
  EXPECT_EQ(read_text("\"central_moment\"", collision), "is \"central_moment\" (did you mean \"central_moments\"?)");
  EXPECT_EQ(read_text("\"bgk\"", collision), "");
  EXPECT_EQ(collision, CollisionOperator{lbm::Bgk{}});
}

TEST(Value, SaysWhatIsExpected) {
  EXPECT_EQ(expected_text(0.0, {positive()}), "a number above 0");
  EXPECT_EQ(expected_text(Vec3(0, 0, 0), {positive()}), "three numbers [x, y, z], each above 0");
  EXPECT_EQ(expected_text(WallSlip{}, {}), "one of \"no_slip\", \"free_slip\", \"wall_model\"");
  EXPECT_EQ(expected_text(std::vector<std::string>{}, {.min_count = 2, .max_count = 2}),
            "a list, each a string, 2 of them");
  EXPECT_EQ(expected_text(std::vector<TimeValue>{}, {.range = non_negative(), .min_count = 2}),
            "a list, each a pair [time, value] at least 0, at least 2 of them");
}

}  // namespace
}  // namespace lahar::scene
