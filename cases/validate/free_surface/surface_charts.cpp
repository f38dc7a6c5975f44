#include "cases/validate/free_surface/surface_charts.h"

#include "cases/pictures/chart.h"

namespace lahar::validate {

void draw_gravity_wave(const Context& context, double reynolds, double period, const std::vector<double>& series,
                       std::span<const double> reference) {
  if (context.plots.empty()) return;
  cases::ChartSeries measured{.name = "Lahar"};
  cases::ChartSeries exact{
      .name = "Prosperetti 1981", .mark = cases::Mark::points, .colour = cases::ChartColour::black};
  for (std::size_t s = 0; s < series.size(); ++s) {
    measured.x.push_back(static_cast<double>(s) / period);
    measured.y.push_back(series[s]);
  }
  for (std::size_t q = 0; q < reference.size(); ++q) {
    exact.x.push_back(0.25 * static_cast<double>(q));
    exact.y.push_back(reference[q]);
  }
  const std::string number = std::to_string(static_cast<int>(reynolds));
  cases::Chart{.title = "Standing wave, Re " + number, .x = {"t / T"}, .y = {"a / a_{0}"}, .series = {measured, exact}}
      .write_all(context.plots / ("gravity_wave_re" + number + ".png"));
}

void draw_front(const Context& context, const std::string& name, const std::vector<double>& time,
                const std::vector<double>& front, std::span<const std::pair<double, double>> measured) {
  if (context.plots.empty()) return;
  const cases::ChartSeries ours{.name = "Lahar", .x = time, .y = front};
  cases::ChartSeries theirs{
      .name = "Martin & Moyce 1952", .mark = cases::Mark::points, .colour = cases::ChartColour::black};
  for (const auto& [t, z] : measured) theirs.x.push_back(t), theirs.y.push_back(z);
  cases::Chart{
      .title = "Front of a collapsing column, n^{2} = 2", .x = {"time T"}, .y = {"front Z"}, .series = {ours, theirs}}
      .write_all(context.plots / (name + ".png"));
}

void draw_depths(const Context& context, const std::string& name, const std::string& title,
                 const std::vector<double>& place, const std::vector<double>& depth, const std::string& author,
                 const std::vector<double>& exact) {
  if (context.plots.empty()) return;
  const cases::ChartSeries ours{.name = "Lahar", .x = place, .y = depth};
  const cases::ChartSeries theirs{
      .name = author, .x = place, .y = exact, .dash = cases::Dash::dashed, .colour = cases::ChartColour::black};
  cases::Chart{.title = title, .x = {"x / h_{0}"}, .y = {"h / h_{0}"}, .series = {ours, theirs}}.write_all(
      context.plots / (name + ".png"));
}

}  // namespace lahar::validate
