// STL: 80 bytes of header, number of triangles, and for each 12 floats (normal, corners) and 2 bytes; or text. Numbers
// of binary files are little-endian, and so is every machine that this is built for.
#include <bit>
#include <cstring>

#include "cases/files/text_lines.h"

namespace lahar::cases {

namespace {

static_assert(std::endian::native == std::endian::little);

constexpr std::size_t kHeader = 84, kTriangle = 50;

void add_triangle(TriangleMesh& mesh) {
  const auto n = static_cast<std::uint32_t>(mesh.points.size());
  mesh.triangles.push_back({n - 3, n - 2, n - 1});
}

TriangleMesh parse_binary(const std::string& bytes) {
  TriangleMesh mesh;
  for (std::size_t at = kHeader; at + kTriangle <= bytes.size(); at += kTriangle) {
    float values[12];
    std::memcpy(values, bytes.data() + at, sizeof values);
    for (std::size_t c = 3; c < 12; c += 3) {
      const Vec3 p(static_cast<double>(values[c]), static_cast<double>(values[c + 1]),
                   static_cast<double>(values[c + 2]));
      if (!p.allFinite()) throw ShapeFileError(fmt::format("triangle {}: a corner is not finite", (at - kHeader) / 50));
      mesh.points.push_back(p);
    }
    add_triangle(mesh);
  }
  return mesh;
}

TriangleMesh parse_text(const std::string& bytes) {
  TriangleMesh mesh;
  TextLines lines(bytes);
  std::vector<std::string_view> words;
  std::size_t corners = 0;
  while (lines.next(words)) {
    if (words[0] == "vertex") {
      if (words.size() != 4) lines.fail("expected \"vertex x y z\"");
      mesh.points.emplace_back(lines.number(words[1]), lines.number(words[2]), lines.number(words[3]));
      ++corners;
    } else if (words[0] == "endfacet" || words[0] == "endloop") {
      if (words[0] == "endloop" && corners != 3) lines.fail(fmt::format("a facet has {} corners, expected 3", corners));
      if (words[0] == "endloop") add_triangle(mesh);
      corners = 0;
    } else if (words[0] != "solid" && words[0] != "facet" && words[0] != "outer" && words[0] != "endsolid") {
      lines.fail(fmt::format("\"{}\" is no word of an STL file", words[0].substr(0, 40)));
    }
  }
  if (corners != 0) throw ShapeFileError("ends inside a facet");
  return mesh;
}

}  // namespace

TriangleMesh parse_stl(const std::string& bytes) {
  if (bytes.size() >= kHeader) {
    std::uint32_t count = 0;
    std::memcpy(&count, bytes.data() + kHeader - sizeof count, sizeof count);
    if (bytes.size() == kHeader + kTriangle * std::size_t{count}) return parse_binary(bytes);
  }
  if (!bytes.starts_with("solid"))
    throw ShapeFileError(
        "is no STL file: neither text that begins with \"solid\" nor as long as its number of triangles says");
  return parse_text(bytes);
}

}  // namespace lahar::cases
