#pragma once
// Faces with any number of corners, cut into triangles.
#include <cstdint>
#include <vector>

#include "core/triangle_mesh.h"

namespace lahar::cases {

/// Adds a face, given by its corners in turn, as triangles that cover the face in its own plane and nothing beside it:
/// the fan from the first corner where that does, ears otherwise. A height of less than 1e-6 of a triangle's longest
/// edge counts as none. The normal is Newell's, so that faces need not be quite plane. Adds nothing and is false where
/// no triangles do, as in a face that crosses itself, or where a face that the fan does not cover has more than 10000
/// corners.
[[nodiscard]] bool add_face(TriangleMesh& mesh, const std::vector<std::uint32_t>& corners);

/// What is wrong with a face that was not added.
inline constexpr const char* kUncutFace =
    "a face cannot be cut into triangles, expected one that does not cross itself, of at most 10000 corners";

}  // namespace lahar::cases
