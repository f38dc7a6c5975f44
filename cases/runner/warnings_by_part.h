#pragma once
// Doubts about one part of a scene each, in the order in which `lahar check` tells them (warnings.h).
#include <string>
#include <vector>

#include "cases/runner/check.h"
#include "cases/scene/scene.h"

namespace lahar::cases {

using Warnings = std::vector<std::string>;

/// Walls, probes, sections, and what lies in walls or falls between cells.
void warn_of_places(const scene::Scene& scene, bool has_fluid, Warnings& list);
/// The fluid, its numbers and its inflows.
void warn_of_fluid(const scene::Scene& scene, const FluidFigures& figures, Warnings& list);
/// Grains and barrier.
void warn_of_solids(const scene::Scene& scene, const SolidsFigures& figures, Warnings& list);
/// How fluid and solids act on each other.
void warn_of_coupling(const scene::Scene& scene, const SolidsFigures& figures, Warnings& list);
/// Friction and restitution of what may touch, and how dense packings are to be.
void warn_of_contacts(const scene::Scene& scene, Warnings& list);
void warn_of_packings(const scene::Scene& scene, Warnings& list);

}  // namespace lahar::cases
