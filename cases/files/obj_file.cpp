// Wavefront OBJ: corners (v) and faces (f) only; everything else is passed over.
#include "cases/files/polygon.h"
#include "cases/files/text_lines.h"

namespace lahar::cases {

TriangleMesh parse_obj(const std::string& bytes) {
  TriangleMesh mesh;
  TextLines lines(bytes);
  std::vector<std::string_view> words;
  while (lines.next(words)) {
    if (words[0] == "v") {
      if (words.size() < 4) lines.fail("expected \"v x y z\"");
      mesh.points.emplace_back(lines.number(words[1]), lines.number(words[2]), lines.number(words[3]));
    }
    if (words[0] != "f") continue;
    if (words.size() < 4) lines.fail("a face has fewer than 3 corners");
    std::vector<std::uint32_t> face;
    for (std::size_t k = 1; k < words.size(); ++k) {  // 7, 7/1, 7/1/2, 7//2; counted from 1, or back from the last
      const long given = lines.whole(words[k].substr(0, words[k].find('/')));
      const auto count = static_cast<long>(mesh.points.size());
      const long index = given < 0 ? count + given : given - 1;
      if (index < 0 || index >= count) lines.fail(fmt::format("corner {} does not exist", given));
      face.push_back(static_cast<std::uint32_t>(index));
    }
    if (!add_face(mesh, face)) lines.fail(kUncutFace);
  }
  return mesh;
}

}  // namespace lahar::cases
