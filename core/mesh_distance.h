#pragma once
// From triangles to a signed distance on a grid.
#include <memory>

#include "core/distance_grid.h"
#include "core/triangle_mesh.h"

namespace lahar {

/// Signed distance to the surface, negative where the upward ray leaves the solid more often than it enters: inside a
/// closed mesh whose faces look outwards, and below a terrain whose faces look up and which covers the box (lower,
/// upper). `spacing` is that of the fine nodes; they cover at least the distance `band` on both sides of the surface.
/// All lengths m. Distances at nodes are exact (of the triangles, in double, stored as float).
std::shared_ptr<const DistanceGrid> sample_distance(const TriangleMesh& mesh, const Vec3& lower, const Vec3& upper,
                                                    double spacing, double band);

}  // namespace lahar
