#include "cases/files/html_image.h"

#include <gtest/gtest.h>

#include <fstream>

#include "cases/files/html_text.h"
#include "tests/cases/files/test_folder.h"

namespace lahar::cases {
namespace {

TEST(HtmlImage, Base64) {  // RFC 4648, section 10
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
}

TEST(HtmlText, NamesMayHoldAnything) { EXPECT_EQ(html_text("<a> & \"b\""), "&lt;a&gt; &amp; &quot;b&quot;"); }

TEST(HtmlImage, HoldsTheFile) {
  const TestFolder folder;
  for (const char* name : {"a.svg", "a.png"}) std::ofstream(folder / name) << "foobar";
  EXPECT_EQ(html_image(folder / "a.svg"), "<img alt=\"a.svg\" src=\"data:image/svg+xml;base64,Zm9vYmFy\">");
  EXPECT_EQ(html_image(folder / "a.png"), "<img alt=\"a.png\" src=\"data:image/png;base64,Zm9vYmFy\">");
}

}  // namespace
}  // namespace lahar::cases
