#include "cases/files/mesh_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <sstream>

namespace lahar::cases {

std::string read_bytes(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::exists(file, error)) throw ShapeFileError("there is no such file");
  if (!std::filesystem::is_regular_file(file, error)) throw ShapeFileError("is no ordinary file");
  constexpr std::uintmax_t most = 1U << 30;
  if (std::filesystem::file_size(file, error) > most) throw ShapeFileError("is larger than 1 GiB");
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  if (!in || (std::filesystem::file_size(file, error) > 0 && !(text << in.rdbuf())))
    throw ShapeFileError("cannot be read");
  return text.str();
}

TriangleMesh read_closed_mesh(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
  const bool stl = ending == ".stl", ply = ending == ".ply", obj = ending == ".obj";
  if (!stl && !ply && !obj) throw ShapeFileError("has an unknown kind of name, expected .stl, .ply or .obj");
  const std::string bytes = read_bytes(file);
  TriangleMesh mesh = stl ? parse_stl(bytes) : ply ? parse_ply(bytes) : parse_obj(bytes);
  weld(mesh);
  if (mesh.triangles.empty()) throw ShapeFileError("has no triangles");
  if (const std::size_t open = open_edges(mesh); open > 0)
    throw ShapeFileError(
        fmt::format("is not closed: {} edges without a face on the other side that agrees on what is "
                    "outside",
                    open));
  const double volume = signed_volume(mesh);
  if (volume == 0) throw ShapeFileError("encloses no volume");
  if (volume < 0) flip(mesh);
  return mesh;
}

}  // namespace lahar::cases
