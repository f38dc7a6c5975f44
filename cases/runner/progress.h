#pragma once
// How far a run is. On a terminal one line that is written over; elsewhere a line for every tenth; silent when quiet.
#include <chrono>
#include <cstdio>
#include <string>

namespace lahar::cases {

enum class ProgressStyle { silent, lines, live };

/// silent when quiet, live on a terminal, else lines.
ProgressStyle progress_style(bool quiet, std::FILE* stream);

/// " 42 %  t = 0.840 s of 2 s  0.0123 s/s  1 min 34 s left". Rate and time left are absent before there is a rate.
/// `from` is where the run began or was resumed.
std::string progress_text(double simulated, double duration, double wall, double from = 0);

/// "1 h 02 min", "3 min 05 s", "12 s".
std::string time_text(double seconds);

class Progress {
 public:
  Progress(double duration, ProgressStyle style, std::FILE* stream = stdout);
  ~Progress() { finish(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// To be told the simulated time (s) after each step; cheap, and allocates only when something is printed.
  void update(double simulated);
  /// Steps begin there (s), and the time that rates count by.
  void start_from(double simulated);
  /// Ends the live line.
  void finish();

 private:
  using Clock = std::chrono::steady_clock;
  void print(double simulated, Clock::time_point now);
  [[nodiscard]] int tenths(double simulated) const;

  double duration_, from_ = 0;
  ProgressStyle style_;
  std::FILE* stream_;
  Clock::time_point start_, last_;
  int last_tenth_ = 0;
  std::size_t line_width_ = 0;
};

}  // namespace lahar::cases
