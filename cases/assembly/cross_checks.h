#pragma once
// Mistakes that only show when parts of a scene are seen together. Each function adds to the findings what it finds,
// and passes over values that are already known to be unsound.
#include "cases/scene/findings.h"
#include "cases/scene/scene.h"

namespace lahar::scene {

/// All of the following.
void check_together(const Scene& scene, Findings& findings);

/// Names that become file and column names; unique where they must be.
void check_names(const Scene& scene, Findings& findings);
/// Every name of a material is one, and every pair of materials is described once.
void check_materials(const Scene& scene, Findings& findings);
/// Boxes, planes and cylinders have an extent; moving walls move along themselves.
void check_shapes(const Scene& scene, Findings& findings);
/// Regions, cells and memory, speed, periodic axes.
void check_fluid(const Scene& scene, Findings& findings);
/// Packings and spheres fit into the domain and between the walls.
void check_grains(const Scene& scene, Findings& findings);
/// The net fits into the channel; dissipator stages.
void check_barrier(const Scene& scene, Findings& findings);
/// Rings have a stiffness, a mesh has laws of its own.
void check_ring_bonds(const Scene& scene, Findings& findings);
/// Tensile laws of a mesh rise, its twists fit into it.
void check_hexagonal_net(const Scene& scene, Findings& findings);
/// Posts are as tall as the net, slender, and stand with the anchors of their cables on the ground.
void check_posts(const Scene& scene, Findings& findings);
/// Rings of this size and pitch interlock and fill the frame: found out by building the net, and only when nothing else
/// is wrong.
void check_net_can_be_built(const Scene& scene, Findings& findings);
/// Coupling and the measured section have what they refer to.
void check_uses(const Scene& scene, Findings& findings);
/// Probes and sections lie in the domain and refer to walls that exist.
void check_probes(const Scene& scene, Findings& findings);

}  // namespace lahar::scene
