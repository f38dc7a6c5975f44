#include "cases/runner/progress.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace lahar::cases {
namespace {

/// A temporary stream whose contents can be read.
struct Capture {
  std::FILE* stream = std::tmpfile();
  ~Capture() { std::fclose(stream); }
  std::string text() const {
    std::rewind(stream);
    std::string all(1 << 16, '\0');
    all.resize(std::fread(all.data(), 1, all.size(), stream));
    return all;
  }
};

TEST(ProgressText, PercentageTimeRateAndTimeLeft) {
  EXPECT_EQ(progress_text(0.5, 2, 10), " 25 %  t = 0.5 s of 2 s  0.05 s/s  30 s left");
  EXPECT_EQ(progress_text(0, 2, 0), "  0 %  t = 0 s of 2 s");
  EXPECT_EQ(progress_text(2.1, 2, 10).substr(0, 5), "100 %");
}

TEST(TimeText, Units) {
  EXPECT_EQ(time_text(12.4), "12 s");
  EXPECT_EQ(time_text(185), "3 min 05 s");
  EXPECT_EQ(time_text(3720), "1 h 02 min");
}

TEST(Progress, SaysALinePerTenthWhereThereIsNoTerminal) {
  const Capture capture;
  {
    Progress progress(1, ProgressStyle::lines, capture.stream);
    for (int i = 1; i <= 1000; ++i) progress.update(i * 0.001);
  }
  const std::string text = capture.text();
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 10) << text;
  EXPECT_EQ(text.find('\r'), std::string::npos);
  EXPECT_EQ(text.substr(0, 5), " 10 %");
}

TEST(Progress, OneLongStepSaysOneLine) {
  const Capture capture;
  Progress progress(1, ProgressStyle::lines, capture.stream);
  progress.update(0.55);
  progress.update(0.56);
  const std::string text = capture.text();
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1) << text;
}

/// A run that goes on says its next tenth, not the one that it was in already.
TEST(Progress, OfARunThatGoesOn) {
  const Capture capture;
  Progress progress(1, ProgressStyle::lines, capture.stream);
  progress.start_from(0.42);
  for (int i = 1; i <= 100; ++i) progress.update(0.42 + i * 0.001);
  const std::string text = capture.text();
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1) << text;
  EXPECT_EQ(text.substr(0, 5), " 50 %");
}

TEST(Progress, IsSilentWhenQuiet) {
  const Capture capture;
  {
    Progress progress(1, ProgressStyle::silent, capture.stream);
    for (int i = 1; i <= 10; ++i) progress.update(i * 0.1);
  }
  EXPECT_EQ(capture.text(), "");
  EXPECT_EQ(progress_style(true, capture.stream), ProgressStyle::silent);
  EXPECT_EQ(progress_style(false, capture.stream), ProgressStyle::lines);
}

}  // namespace
}  // namespace lahar::cases
