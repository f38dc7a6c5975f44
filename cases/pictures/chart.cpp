#include "cases/pictures/chart.h"

#include <array>
#include <cmath>

#include "cases/files/output_file.h"
#include "cases/files/png_file.h"
#include "cases/pictures/chart_legend.h"
#include "core/check.h"

namespace lahar::cases {

namespace {

constexpr float kPixelsPerPoint = 3;

void check(const Chart& chart) {
  require(chart.width >= 150 && chart.height >= 110, "Chart: too small");
  for (const ChartSeries& s : chart.series) {
    const std::size_t n = s.x.size();
    require(
        s.y.size() == n && (s.error.empty() || s.error.size() == n) && s.upper.size() == (s.mark == Mark::band ? n : 0),
        "Chart: the lists of a series differ in length");
  }
}

Occupancy taken_by_data(const Chart& chart, const ChartFrame& frame) {
  Occupancy taken;
  for (const ChartSeries& s : chart.series) occupy(taken, s, frame);
  for (const ChartGuide& g : chart.x_guides)
    taken.add_line(std::array{frame.at(g.at, frame.y.low), frame.at(g.at, frame.y.high)});
  for (const ChartGuide& g : chart.y_guides)
    taken.add_line(std::array{frame.at(frame.x.low, g.at), frame.at(frame.x.high, g.at)});
  return taken;
}

void draw_data(Canvas& canvas, const Chart& chart, const ChartFrame& frame) {
  const auto looks = looks_of(chart.series);
  const auto draw_all = [&](Mark mark) {
    for (std::size_t n = 0; n < chart.series.size(); ++n)
      if (chart.series[n].mark == mark) draw_series(canvas, chart.series[n], looks[n], frame);
  };
  for (const Mark mark : {Mark::band, Mark::line, Mark::line_and_points, Mark::points}) draw_all(mark);
}

void draw(Canvas& canvas, const Chart& chart) {
  check(chart);
  canvas.rectangle(Point(0, 0), Point(chart.width, chart.height), Colour::Ones());
  ChartFrame frame = frame_of(chart, canvas, 0);
  Occupancy taken = taken_by_data(chart, frame);
  const ChartLegend legend = legend_of(chart, canvas, frame, taken);
  if (legend.above > 0) frame = frame_of(chart, canvas, legend.above), taken = taken_by_data(chart, frame);
  if (legend.ground) taken.add_box(*legend.ground);
  draw_grid(canvas, frame);
  draw_guides(canvas, chart, frame, taken);
  draw_axes(canvas, chart, frame);
  draw_data(canvas, chart, frame);
  draw_legend(canvas, chart, legend);
}

std::string document_of(const Chart& chart, Canvas::Medium medium) {
  Canvas canvas(medium, chart.width, chart.height);
  draw(canvas, chart);
  return canvas.document();
}

}  // namespace

Image Chart::image() const {
  Canvas canvas(Canvas::Medium::pixels, width, height, kPixelsPerPoint);
  draw(canvas, *this);
  Image image(static_cast<int>(std::lround(width * kPixelsPerPoint)),
              static_cast<int>(std::lround(height * kPixelsPerPoint)));
  canvas.lay_over(image);
  return image;
}

void Chart::write(const std::filesystem::path& path) const {
  const std::string ending = path.extension();
  require(ending == ".png" || ending == ".svg" || ending == ".pdf", "Chart: writes .png, .svg or .pdf");
  if (ending == ".png") return write_png(path, image());
  replace_text_file(path, document_of(*this, ending == ".svg" ? Canvas::Medium::svg : Canvas::Medium::pdf));
}

void Chart::write_all(const std::filesystem::path& path) const {
  for (const char* ending : {".png", ".svg", ".pdf"}) write(std::filesystem::path(path).replace_extension(ending));
}

}  // namespace lahar::cases
