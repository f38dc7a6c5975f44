#pragma once
// Triangles from files.
#include <filesystem>
#include <stdexcept>
#include <string>

#include "core/triangle_mesh.h"

namespace lahar::cases {

/// What is wrong with a file, in words that follow its name: "line 7: expected a number".
struct ShapeFileError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The bytes of an ordinary file.
std::string read_bytes(const std::filesystem::path& file);

/// Each makes a mesh of the contents of a file; corners are not welded. Polygons are cut into triangles (polygon.h).
TriangleMesh parse_stl(const std::string& bytes);  ///< text or binary
TriangleMesh parse_ply(const std::string& bytes);  ///< text or binary, either byte order
TriangleMesh parse_obj(const std::string& bytes);  ///< v and f

/// Reads by the ending of the name (.stl, .ply, .obj), welds equal corners and turns the faces of a closed mesh
/// outwards; those of a cavity look into it. Throws ShapeFileError if the file cannot be read, is malformed, has no
/// triangles, is not closed, or holds bodies of which some are inside out and others are not.
TriangleMesh read_closed_mesh(const std::filesystem::path& file);

}  // namespace lahar::cases
