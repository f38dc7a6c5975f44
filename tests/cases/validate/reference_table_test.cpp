#include "cases/validate/reference_table.h"

#include <gtest/gtest.h>

#include "core/check.h"

namespace lahar::validate {
namespace {

const std::string kText =
    "# From a book\n"
    "# Trust: high\n"
    "set,x,\"y, \"\"quoted\"\"\"\n"
    "a,1,2.5\n"
    "\"b, c\",3,-4e-3\n"
    "a,5,none\n";

ReferenceTable table() { return ReferenceTable::parse(kText, "t.csv"); }

/// The first line of what is thrown.
template <class Ask>
std::string mistake_of(const Ask& ask) {
  try {
    ask();
  } catch (const InputError& e) {
    return e.what();
  }
  return "nothing was thrown";
}

TEST(ReferenceTable, ReadsColumnsAndProvenance) {
  EXPECT_EQ(table().provenance(), (std::vector<std::string>{"From a book", "Trust: high"}));
  EXPECT_EQ(table().size(), 3u);
  EXPECT_EQ(table().numbers("x"), (std::vector<double>{1, 3, 5}));
  const ReferenceTable b = table().where("set", "b, c");
  EXPECT_EQ(b.number("y, \"quoted\""), -4e-3);
  EXPECT_EQ(b.points("x", "y, \"quoted\""), (std::vector<std::pair<double, double>>{{3, -4e-3}}));
}

TEST(ReferenceTable, NamesThePlaceOfAMistake) {
  EXPECT_EQ(mistake_of([] { (void)table().numbers("y, \"quoted\""); }),
            "t.csv:6:5: y, \"quoted\" is \"none\", expected a number");
  EXPECT_EQ(mistake_of([] { (void)table().numbers("z"); }), "t.csv:3:1: no column \"z\"");
  EXPECT_EQ(mistake_of([] { (void)table().where("x", "2"); }), "t.csv:3:5: no row whose x is \"2\"");
  EXPECT_EQ(mistake_of([] { (void)table().number("x"); }), "t.csv:3:1: 3 rows to take \"x\" from, expected one");
}

TEST(ReferenceTable, RefusesWhatIsNoTable) {
  const auto parse = [](const std::string& text) {
    return mistake_of([&] { (void)ReferenceTable::parse(text, "t.csv"); });
  };
  EXPECT_EQ(parse("# s\na,b\n1,2\n3\n"), "t.csv:4:1: 1 fields, expected 2");
  EXPECT_EQ(parse("# s\na,b\n1,\"2\n"), "t.csv:3:3: a quote that is not closed");
  EXPECT_EQ(parse("a,b\n1,2\n"), "t.csv:1:1: no provenance, expected lines that begin with #");
  EXPECT_EQ(parse("# s\na,b\n"), "t.csv:2:1: no rows");
  EXPECT_EQ(parse("# s\na\n1\n# late\n"), "t.csv:4:1: remark among the rows, expected all of them at the start");
  EXPECT_NE(mistake_of([] { (void)reference("none.csv"); }).find("none.csv:0:0: cannot be read"), std::string::npos);
}

}  // namespace
}  // namespace lahar::validate
