#pragma once
// The core objects that a scene describes: walls, hydrographs and materials.
#include <optional>

#include "cases/scene/scene.h"
#include "core/geometry.h"
#include "core/triangle_mesh.h"
#include "dem/material.h"
#include "lbm/free_surface/hydrograph.h"

namespace lahar::scene {

/// One wall; `material` is -1 where the scene names none.
Wall make_wall(const WallSettings& settings, int material);

/// The body that a region of liquid fills, none for a box.
std::optional<Shape> make_body(const FluidRegion& region);

/// What an inflow box brings over time.
lbm::Hydrograph hydrograph_of(const Inflow& inflow);

/// All walls, in the order of the scene.
Walls make_walls(const Scene& scene);

/// m: how far below its top a box is open, to the bottom of the lowest of nine layers that walls do not take all of,
/// judged at the points of a lattice. None where walls take all of the box.
std::optional<double> open_depth(const Walls& walls, const Vec3& lower, const Vec3& upper);

/// Whether walls take all of a box, judged at the points of a lattice.
bool filled_by_walls(const Walls& walls, const Vec3& lower, const Vec3& upper);

/// The area of a heightmap where it is placed, each point in the middle of a square, and the range of its heights, m.
/// Reads its file again. Throws cases::ShapeFileError.
Bounds heightmap_bounds(const WallSettings& settings);

/// All materials in the order of the scene, moduli times solids.contact_modulus_scale, with the pairs of all contacts.
dem::Materials make_materials(const Scene& scene);

}  // namespace lahar::scene
