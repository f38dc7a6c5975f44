#pragma once
// The separate bodies of a closed mesh.
#include <optional>
#include <vector>

#include "core/triangle_mesh.h"

namespace lahar::cases {

/// Parts of a mesh that share no corner with each other, in the order of their first triangles.
std::vector<TriangleMesh> bodies_of(const TriangleMesh& mesh);

/// The extent of the first body that is inside out: it encloses less than no volume and lies in no other, so that it is
/// no cavity either. None where there is none. The mesh must be closed and welded.
std::optional<Bounds> body_inside_out(const TriangleMesh& mesh);

}  // namespace lahar::cases
