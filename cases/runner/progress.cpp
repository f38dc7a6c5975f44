#include "cases/runner/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>

namespace lahar::cases {

ProgressStyle progress_style(bool quiet, std::FILE* stream) {
  if (quiet) return ProgressStyle::silent;
  return isatty(fileno(stream)) ? ProgressStyle::live : ProgressStyle::lines;
}

std::string time_text(double seconds) {
  if (!(seconds < 3.6e9)) return "more than a million hours";
  const auto s = static_cast<long long>(seconds + 0.5);
  if (s >= 3600) return fmt::format("{} h {:02} min", s / 3600, s / 60 % 60);
  if (s >= 60) return fmt::format("{} min {:02} s", s / 60, s % 60);
  return fmt::format("{} s", s);
}

std::string progress_text(double simulated, double duration, double wall, double from) {
  const double part = std::clamp(simulated / duration, 0.0, 1.0);
  std::string text = fmt::format("{:3.0f} %  t = {:.4g} s of {:.4g} s", 100 * part, simulated, duration);
  if (simulated <= from || wall <= 0) return text;
  const double rate = (simulated - from) / wall;
  return text + fmt::format("  {:.3g} s/s  {} left", rate, time_text(std::max(0.0, duration - simulated) / rate));
}

Progress::Progress(double duration, ProgressStyle style, std::FILE* stream)
    : duration_(duration), style_(style), stream_(stream), start_(Clock::now()), last_(start_) {}

int Progress::tenths(double simulated) const { return static_cast<int>(10 * simulated / duration_ * (1 + 1e-12)); }

void Progress::start_from(double simulated) {
  from_ = simulated;
  start_ = last_ = Clock::now();
  last_tenth_ = tenths(simulated);
}

void Progress::update(double simulated) {
  if (style_ == ProgressStyle::silent) return;
  const int tenth = tenths(simulated);
  if (style_ == ProgressStyle::lines) {
    if (tenth > last_tenth_) print(simulated, Clock::now());
    last_tenth_ = std::max(last_tenth_, tenth);
    return;
  }
  const auto now = Clock::now();
  if (now - last_ >= std::chrono::milliseconds(200)) print(simulated, now);
}

void Progress::print(double simulated, Clock::time_point now) {
  last_ = now;
  const std::string text =
      progress_text(simulated, duration_, std::chrono::duration<double>(now - start_).count(), from_);
  if (style_ == ProgressStyle::live) {
    // Padded, so that nothing of a longer line before it remains.
    line_width_ = std::max(line_width_, text.size());
    std::fputs(fmt::format("\r{:<{}}", text, line_width_).c_str(), stream_);
  } else {
    std::fputs((text + "\n").c_str(), stream_);
  }
  std::fflush(stream_);
}

void Progress::finish() {
  if (style_ == ProgressStyle::live && line_width_ > 0) std::fputs("\n", stream_);
  line_width_ = 0;
}

}  // namespace lahar::cases
