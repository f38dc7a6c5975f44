#include "cases/files/heightmap_file.h"

#include <algorithm>
#include <map>
#include <optional>

#include "cases/files/text_lines.h"

namespace lahar::cases {

double Heightmap::lowest() const { return *std::min_element(heights.begin(), heights.end()); }
double Heightmap::highest() const { return *std::max_element(heights.begin(), heights.end()); }

namespace {

std::string lower_case(std::string_view word) {
  std::string text(word);
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

bool header_word(std::string_view word) {
  return !word.empty() && std::isalpha(static_cast<unsigned char>(word[0])) && lower_case(word) != "nan" &&
         lower_case(word) != "inf";
}

using Keys = std::map<std::string, double>;

/// Reads the header; `words` is left at the first row of numbers.
Keys read_header(TextLines& lines, std::vector<std::string_view>& words) {
  Keys keys;
  for (; !words.empty() && header_word(words[0]); lines.next(words)) {
    const std::string key = lower_case(words[0]);
    static const std::vector<std::string> known{"ncols",     "nrows",     "xllcorner", "yllcorner",
                                                "xllcenter", "yllcenter", "cellsize",  "nodata_value"};
    if (words.size() != 2 || std::find(known.begin(), known.end(), key) == known.end())
      lines.fail(fmt::format("\"{}\" is no line of an ASCII grid's header", words[0].substr(0, 40)));
    keys[key] = lines.number(words[1]);
  }
  return keys;
}

/// Of an ASCII grid whose header does not say what stands for no data (Esri's format).
constexpr double kNoData = -9999;

void apply_header(const Keys& keys, Heightmap& map) {
  for (const char* key : {"ncols", "nrows", "cellsize"})
    if (!keys.contains(key)) throw ShapeFileError(fmt::format("has no {} in its header", key));
  map.spacing = keys.at("cellsize");
  if (!(map.spacing > 0)) throw ShapeFileError("has a cellsize that is not above 0");
  for (const auto& [axis, place] : {std::pair{"x", &map.x}, std::pair{"y", &map.y}}) {
    const std::string corner = std::string(axis) + "llcorner", centre = std::string(axis) + "llcenter";
    if (keys.contains(centre))
      *place = keys.at(centre);
    else if (keys.contains(corner))
      *place = keys.at(corner) + map.spacing / 2;
    else
      throw ShapeFileError(fmt::format("has neither {} nor {} in its header", corner, centre));
  }
  const double columns = keys.at("ncols"), rows = keys.at("nrows");
  if (columns != static_cast<double>(map.columns) || rows != static_cast<double>(map.rows))
    throw ShapeFileError(fmt::format("has {} rows of {} numbers, expected {} rows of {} as its header says", map.rows,
                                     map.columns, rows, columns));
  const double none = keys.contains("nodata_value") ? keys.at("nodata_value") : kNoData;
  const auto holes = std::count(map.heights.begin(), map.heights.end(), none);
  if (holes > 0) throw ShapeFileError(fmt::format("has {} points without data, expected none: fill them first", holes));
}

}  // namespace

Heightmap parse_heightmap(const std::string& bytes, double spacing) {
  TextLines lines(bytes);
  std::vector<std::string_view> words;
  lines.next(words);
  const Keys keys = read_header(lines, words);
  Heightmap map;
  std::vector<std::vector<double>> rows;
  // The numbers of an ASCII grid may be broken into lines at will; a plain matrix has a row in each.
  const std::size_t wanted = keys.contains("ncols") ? static_cast<std::size_t>(std::max(0.0, keys.at("ncols"))) : 0;
  std::vector<double> row;
  for (; !words.empty(); lines.next(words)) {
    for (const std::string_view word : words) {
      row.push_back(lines.number(word));
      if (wanted > 0 && row.size() == wanted) rows.push_back(std::move(row)), row.clear();
    }
    if (wanted > 0) continue;
    if (!rows.empty() && row.size() != rows[0].size())
      lines.fail(fmt::format("has {} numbers, expected {} as in the first row", row.size(), rows[0].size()));
    rows.push_back(std::move(row));
    row.clear();
  }
  if (!row.empty()) throw ShapeFileError("ends inside a row of numbers");
  map.rows = rows.size();
  map.columns = rows.empty() ? 0 : rows[0].size();
  if (map.rows < 2 || map.columns < 2) throw ShapeFileError("has less than two rows of two heights");
  for (auto r = rows.rbegin(); r != rows.rend(); ++r) map.heights.insert(map.heights.end(), r->begin(), r->end());
  if (!keys.empty() && spacing > 0)
    throw ShapeFileError("has a header with its cellsize, expected no spacing_m with it");
  map.spacing = spacing;
  if (!keys.empty()) apply_header(keys, map);
  if (!(map.spacing > 0)) throw ShapeFileError("is a plain matrix, expected spacing_m above 0 with it");
  return map;
}

Heightmap placed(Heightmap map, double scale, const Vec3& translate) {
  map.x = map.x * scale + translate.x();
  map.y = map.y * scale + translate.y();
  map.spacing *= scale;
  for (double& h : map.heights) h = h * scale + translate.z();
  return map;
}

namespace {

struct Line {
  double place;
  std::size_t index;  ///< of the point whose height holds
};

/// Lines of points over [lower, upper]: those of the map in between and one beyond on either side, and the ends of the
/// range where the map does not reach so far.
std::vector<Line> lines_over(double start, double spacing, std::size_t count, double lower, double upper) {
  std::vector<Line> lines;
  if (start > lower) lines.push_back({lower, 0});
  for (std::size_t k = 0; k < count; ++k) {
    const double place = start + spacing * static_cast<double>(k);
    if (place + spacing > lower && place - spacing < upper) lines.push_back({place, k});
  }
  const double end = start + spacing * static_cast<double>(count - 1);
  if (end <= lower) lines.push_back({lower, count - 1});
  if (end < upper) lines.push_back({upper, count - 1});
  if (start >= upper) lines.push_back({upper, 0});
  std::sort(lines.begin(), lines.end(), [](const Line& a, const Line& b) { return a.place < b.place; });
  lines.erase(std::unique(lines.begin(), lines.end(), [](const Line& a, const Line& b) { return a.place == b.place; }),
              lines.end());
  return lines;
}

}  // namespace

TriangleMesh terrain(const Heightmap& map, const Vec3& lower, const Vec3& upper) {
  const auto across = lines_over(map.x, map.spacing, map.columns, lower.x(), upper.x());
  const auto along = lines_over(map.y, map.spacing, map.rows, lower.y(), upper.y());
  TriangleMesh mesh;
  for (const Line& y : along)
    for (const Line& x : across) mesh.points.emplace_back(x.place, y.place, map.at(x.index, y.index));
  const auto n = static_cast<std::uint32_t>(across.size());
  for (std::uint32_t j = 0; j + 1 < along.size(); ++j)
    for (std::uint32_t i = 0; i + 1 < n; ++i) {
      const std::uint32_t a = j * n + i, b = a + 1, c = a + n, d = c + 1;
      mesh.triangles.push_back({a, b, d});
      mesh.triangles.push_back({a, d, c});
    }
  return mesh;
}

}  // namespace lahar::cases
