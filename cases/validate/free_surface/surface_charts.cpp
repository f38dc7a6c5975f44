#include "cases/validate/free_surface/surface_charts.h"

#include <array>

#include "cases/files/png_file.h"
#include "cases/pictures/chart.h"

namespace lahar::validate {

void draw_gravity_wave(const Context& context, double reynolds, double period, const std::vector<double>& series,
                       std::span<const double> reference) {
  if (context.plots.empty()) return;
  cases::ChartLine measured{"Lahar", {}, {}, false}, exact{"Prosperetti 1981, every quarter of a period", {}, {}, true};
  for (std::size_t s = 0; s < series.size(); ++s) {
    measured.x.push_back(static_cast<double>(s) / period);
    measured.y.push_back(series[s]);
  }
  for (std::size_t q = 0; q < reference.size(); ++q) {
    exact.x.push_back(0.25 * static_cast<double>(q));
    exact.y.push_back(reference[q]);
  }
  const std::string number = std::to_string(static_cast<int>(reynolds));
  const std::array<cases::ChartLine, 2> lines{measured, exact};
  cases::write_png(
      context.plots / ("gravity_wave_re" + number + ".png"),
      cases::draw_chart(lines, {.title = "Standing wave, Re " + number, .x_label = "t / T", .y_label = "a / a0"}));
}

void draw_front(const Context& context, const std::string& name, const std::vector<double>& time,
                const std::vector<double>& front, std::span<const std::pair<double, double>> measured) {
  if (context.plots.empty()) return;
  cases::ChartLine ours{"Lahar", time, front, false}, theirs{"Martin and Moyce 1952", {}, {}, true};
  for (const auto& [t, z] : measured) theirs.x.push_back(t), theirs.y.push_back(z);
  const std::array<cases::ChartLine, 2> lines{ours, theirs};
  cases::write_png(
      context.plots / (name + ".png"),
      cases::draw_chart(lines, {.title = "Front of a collapsing column, n^2 = 2", .x_label = "T", .y_label = "Z"}));
}

}  // namespace lahar::validate
