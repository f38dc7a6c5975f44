#include "cases/pictures/glyphs.h"

#include <algorithm>
#include <array>
#include <map>
#include <string_view>

namespace lahar::cases {

namespace {

// Strokes are separated by ';', points are digit pairs x y on a grid whose baseline is y = 2, capitals reach 8. A
// stroke that starts with '~' is smooth: its points are the control polygon of a quadratic spline.
struct Drawing {
  char character;
  std::string_view strokes;
};

constexpr std::array kDrawings{
    Drawing{'0', "~28 48 42 02 08 28"},
    Drawing{'1', "16 28 22"},
    Drawing{'2', "~06 08 48 45 02;02 42"},
    Drawing{'3', "~06 08 48 45 25;~25 45 42 02 04"},
    Drawing{'4', "32 38 04 44"},
    Drawing{'5', "48 08 05;~05 06 46 42 02 03"},
    Drawing{'6', "~47 48 08 02 42 46 06 04"},
    Drawing{'7', "08 48 12"},
    Drawing{'8', "~25 05 08 48 45 25;~25 05 02 42 45 25"},
    Drawing{'9', "~03 02 42 48 08 04 44 46"},
    Drawing{'A', "02 28 42;14 34"},
    Drawing{'B', "22 02 08 28;~28 48 45 25;25 05;~25 45 42 22"},
    Drawing{'C', "~46 48 08 02 42 44"},
    Drawing{'D', "12 02 08 18;~18 48 42 12"},
    Drawing{'E', "48 08 02 42;05 35"},
    Drawing{'F', "48 08 02;05 35"},
    Drawing{'G', "~46 48 08 02 42 45;45 25"},
    Drawing{'H', "02 08;42 48;05 45"},
    Drawing{'I', "02 08"},
    Drawing{'J', "38 34;~34 32 02 04"},
    Drawing{'K', "08 02;48 04;15 42"},
    Drawing{'L', "08 02 32"},
    Drawing{'M', "02 08 24 48 42"},
    Drawing{'N', "02 08 42 48"},
    Drawing{'O', "~28 48 42 02 08 28"},
    Drawing{'P', "02 08 28;~28 48 45 25;25 05"},
    Drawing{'Q', "~28 48 42 02 08 28;24 42"},
    Drawing{'R', "02 08 28;~28 48 45 25;25 05;25 42"},
    Drawing{'S', "~46 48 08 05 45 42 02 04"},
    Drawing{'T', "08 48;28 22"},
    Drawing{'U', "08 04;~04 02 42 44;44 48"},
    Drawing{'V', "08 22 48"},
    Drawing{'W', "08 12 26 32 48"},
    Drawing{'X', "02 48;08 42"},
    Drawing{'Y', "08 25 48;25 22"},
    Drawing{'Z', "08 48 02 42"},
    Drawing{'a', "36 32;~34 36 06 02 32 34"},
    Drawing{'b', "08 02;~04 06 36 32 02 04"},
    Drawing{'c', "~35 36 06 02 32 33"},
    Drawing{'d', "38 32;~34 36 06 02 32 34"},
    Drawing{'e', "04 34;~34 36 06 02 32 33"},
    Drawing{'f', "~38 18 15;15 12;06 26"},
    Drawing{'g', "36 32;~34 36 06 02 32 34;~32 30 00"},
    Drawing{'h', "08 02;~04 06 36 34;34 32"},
    Drawing{'i', "06 02;08 08"},
    Drawing{'j', "16 12;~12 10 00;18 18"},
    Drawing{'k', "08 02;36 03;14 32"},
    Drawing{'l', "08 02"},
    Drawing{'m', "06 02;~04 06 26 24;24 22;~24 26 46 44;44 42"},
    Drawing{'n', "06 02;~04 06 36 34;34 32"},
    Drawing{'o', "~04 06 36 32 02 04"},
    Drawing{'p', "06 00;~04 06 36 32 02 04"},
    Drawing{'q', "36 30;~34 36 06 02 32 34"},
    Drawing{'r', "06 02;~04 06 26"},
    Drawing{'s', "~35 36 06 04 34 32 02 03"},
    Drawing{'t', "18 14;~14 12 32;06 36"},
    Drawing{'u', "06 04;~04 02 32 34;36 32"},
    Drawing{'v', "06 22 46"},
    Drawing{'w', "06 12 26 32 46"},
    Drawing{'x', "02 36;06 32"},
    Drawing{'y', "06 22;46 10"},
    Drawing{'z', "06 36 02 32"},
    Drawing{'.', "02 02"},
    Drawing{',', "02 01"},
    Drawing{':', "03 03;05 05"},
    Drawing{';', "03 02;05 05"},
    Drawing{'!', "08 04;02 02"},
    Drawing{'?', "~06 08 48 45 25;25 24;22 22"},
    Drawing{'-', "05 25"},
    Drawing{'+', "05 45;23 27"},
    Drawing{'=', "04 44;06 46"},
    Drawing{'/', "01 39"},
    Drawing{'(', "~19 07 03 11"},
    Drawing{')', "~09 17 13 01"},
    Drawing{'[', "19 09 01 11"},
    Drawing{']', "09 19 11 01"},
    Drawing{'%', "~18 28 26 06 08 18;~34 44 42 22 24 34;02 48"},
    Drawing{'_', "01 41"},
    Drawing{'^', "06 28 46"},
    Drawing{'\'', "08 06"},
    Drawing{'*', "24 28;05 47;07 45"},
    Drawing{'<', "47 05 43"},
    Drawing{'>', "07 45 03"},
    Drawing{'|', "01 09"},
    Drawing{' ', ""},
};

using Stroke = std::vector<Eigen::Vector2f>;

// Chaikin's corner cutting: converges to the quadratic spline of the control polygon; the ends stay.
Stroke cut_corners(const Stroke& polygon) {
  Stroke finer{polygon.front()};
  for (std::size_t i = 0; i + 1 < polygon.size(); ++i) {
    if (i > 0) finer.push_back(0.75F * polygon[i] + 0.25F * polygon[i + 1]);
    if (i + 2 < polygon.size()) finer.push_back(0.25F * polygon[i] + 0.75F * polygon[i + 1]);
  }
  finer.push_back(polygon.back());
  return finer;
}

Stroke parse_stroke(std::string_view text) {
  const bool smooth = text.starts_with('~');
  Stroke points;
  for (std::size_t n = smooth ? 1 : 0; n + 1 < text.size(); n += 3)
    points.emplace_back(static_cast<float>(text[n] - '0'), static_cast<float>(text[n + 1] - '2'));
  for (int level = 0; smooth && level < 4; ++level) points = cut_corners(points);
  return points;
}

Glyph parse_glyph(std::string_view strokes) {
  Glyph glyph;
  while (!strokes.empty()) {
    const std::size_t end = std::min(strokes.find(';'), strokes.size());
    glyph.strokes.push_back(parse_stroke(strokes.substr(0, end)));
    strokes.remove_prefix(std::min(end + 1, strokes.size()));
  }
  for (const Stroke& stroke : glyph.strokes)
    for (const auto& point : stroke) glyph.width = std::max(glyph.width, point.x());
  return glyph;
}

std::map<char, Glyph> all_glyphs() {
  std::map<char, Glyph> glyphs;
  for (const Drawing& drawing : kDrawings) glyphs[drawing.character] = parse_glyph(drawing.strokes);
  glyphs[' '].width = 1.5F;
  glyphs['1'].width = 4;  // digits share one width, so that a running clock does not jitter
  return glyphs;
}

}  // namespace

const Glyph& glyph_of(char character) {
  static const std::map<char, Glyph> glyphs = all_glyphs();
  static const Glyph unknown = parse_glyph("02 08 48 42 02");
  const auto found = glyphs.find(character);
  return found == glyphs.end() ? unknown : found->second;
}

}  // namespace lahar::cases
