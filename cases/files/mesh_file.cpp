#include "cases/files/mesh_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <sstream>

#include "cases/files/mesh_bodies.h"

namespace lahar::cases {

namespace {

/// Turns all faces round where that is what puts the bodies in order. Throws ShapeFileError where nothing does.
void turn_outwards(TriangleMesh& mesh) {
  const std::optional<Bounds> wrong = body_inside_out(mesh);
  if (!wrong) return;
  flip(mesh);
  if (!body_inside_out(mesh)) return;
  throw ShapeFileError(fmt::format(
      "has a body from ({:g}, {:g}, {:g}) to ({:g}, {:g}, {:g}) in the file's own units whose faces look "
      "inwards while those of another look outwards, expected outwards for all (into a cavity for its own)",
      wrong->lower.x(), wrong->lower.y(), wrong->lower.z(), wrong->upper.x(), wrong->upper.y(), wrong->upper.z()));
}

}  // namespace

std::string read_bytes(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::exists(file, error))
    throw ShapeFileError(
        "there is no such file, expected a path from the folder of the scene, or with --set from the working folder");
  if (!std::filesystem::is_regular_file(file, error))
    throw ShapeFileError("is no ordinary file, expected one with data");
  constexpr std::uintmax_t most = 1U << 30;
  if (std::filesystem::file_size(file, error) > most)
    throw ShapeFileError("is larger than 1 GiB, expected at most that");
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  if (!in || (std::filesystem::file_size(file, error) > 0 && !(text << in.rdbuf())))
    throw ShapeFileError("cannot be read");
  const std::string bytes = text.str();
  return bytes.starts_with("\xEF\xBB\xBF") ? bytes.substr(3) : bytes;  // the mark of a text in UTF-8
}

TriangleMesh read_closed_mesh(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
  const bool stl = ending == ".stl", ply = ending == ".ply", obj = ending == ".obj";
  if (!stl && !ply && !obj) throw ShapeFileError("has an unknown kind of name, expected .stl, .ply or .obj");
  const std::string bytes = read_bytes(file);
  TriangleMesh mesh = stl ? parse_stl(bytes) : ply ? parse_ply(bytes) : parse_obj(bytes);
  weld(mesh);
  if (mesh.triangles.empty()) throw ShapeFileError("has no triangles, expected a closed surface of them");
  if (const std::size_t open = open_edges(mesh); open > 0)
    throw ShapeFileError(
        fmt::format("is not closed: {} edges without a face on the other side that agrees on what is "
                    "outside, expected none",
                    open));
  turn_outwards(mesh);
  if (signed_volume(mesh) == 0) throw ShapeFileError("encloses no volume, expected a solid body");
  return mesh;
}

}  // namespace lahar::cases
