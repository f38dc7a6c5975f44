#pragma once
// Charts for print and screen: lines, points, error bars and bands over linear or logarithmic axes.
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cases/files/image.h"
#include "cases/pictures/axis.h"

namespace lahar::cases {

enum class Mark { line, points, line_and_points, band };
enum class Dash { solid, dashed, dotted, dash_dot };
/// Told apart with the common forms of colour blindness (after Okabe & Ito 2008, darkened for thin lines).
enum class ChartColour { blue, vermilion, green, purple, amber, sky, black };

/// Of points.
enum class PointShape { circle, square, triangle, diamond, triangle_down };

/// One curve or set of points. Texts are as in text_markup. What an axis cannot show leaves a gap.
struct ChartSeries {
  std::string name{};  ///< in the legend; may be empty
  std::vector<double> x{}, y{};
  Mark mark = Mark::line;
  Dash dash = Dash::solid;
  std::optional<ChartColour> colour{};  ///< otherwise by its number in the chart
  std::optional<PointShape> shape{};    ///< the same
  std::vector<double> error{};          ///< half the length of the error bars along y; may be empty
  std::vector<double> upper{};          ///< of a band, which goes from y up to here
};

/// A thin dashed line across the chart with its name along it.
struct ChartGuide {
  double at;
  std::string name{};
};

struct Chart {
  std::string title{};
  Axis x{}, y{};
  std::vector<ChartSeries> series{};
  std::vector<ChartGuide> x_guides{}, y_guides{};  ///< at a value of x (upright), of y (level)
  float width = 400, height = 250;                 ///< points of 1/72 inch; letters are 10 points

  /// As a picture with 3 pixels per point. All three throw std::logic_error if the lists of a series differ in length
  /// or the chart is smaller than 150 x 110 points.
  [[nodiscard]] Image image() const;
  /// Writes .png, .svg or .pdf, by the ending of the name. Throws FileError.
  void write(const std::filesystem::path& path) const;
  /// Writes all of them beside each other; the ending of the name is replaced.
  void write_all(const std::filesystem::path& path) const;
};

}  // namespace lahar::cases
