#pragma once
// How much memory a fluid and particles take, and how much there is.
#include <cstddef>

#include "cases/scene/scene.h"
#include "core/geometry.h"

namespace lahar::scene {

/// Bytes that blocks of 8^3 cells of the fluid take in a run: populations, types, fields of the surface, links into
/// walls, notes of changes; fields of bodies in the `with_bodies` of them that grains or wires reach. Every block that
/// liquid is filled into gets fields of a surface, which stay in reserve.
double bytes_of_blocks(const Scene& scene, double blocks, double with_bodies);

/// How many of so many blocks grains and wires reach, at most. `spreading`: how many times more than at the start.
double blocks_with_bodies(const Scene& scene, double blocks, double spreading);

/// Bytes that a cell takes while liquid is filled in: in lists, which are given back before bodies come.
inline constexpr double kBytesPerFilledCell = 32;

/// Bytes that a grain or a bead takes, with its neighbours, contacts and bonds.
inline constexpr double kBytesPerParticle = 1000;

/// Nodes of the averaged coupling, which stand in the whole domain; 0 without it.
double averaging_nodes(const Scene& scene);

/// Bytes that such a node takes in memory (AveragedExchange::Node) and in a checkpoint.
inline constexpr double kBytesPerNode = 96, kStoredBytesPerNode = 40;

/// Bytes of what is kept for the whole domain, wet or dry: those nodes, and the bed of each column of cells.
double bytes_of_domain(const Scene& scene);

/// Bytes of the fluid: at the start with blocks that liquid of so many cells is filled into, and when it has spread.
double bytes_at_start(const Scene& scene, double blocks, double cells);
double bytes_when_spread(const Scene& scene, double blocks, double spreading);

/// What becomes liquid of the box around a region: what its shape holds outside walls and of no region before it.
struct LiquidOfRegion {
  double share;  ///< of the box
  double depth;  ///< m, largest along z
};
/// With a `margin` (m), what is so near to the liquid, too. Judged at the points of a lattice.
LiquidOfRegion liquid_of_region(const Scene& scene, const Walls& walls, std::size_t region, double margin = 0);

/// Cells of the liquid at the start.
double liquid_cells(const Scene& scene);

/// Of the liquid that inflow boxes bring by a time (s), if they can.
double inflow_cells(const Scene& scene, double time);

/// Physical memory of this machine, bytes.
std::size_t physical_memory();

}  // namespace lahar::scene
