#pragma once
// Dense random packings of spheres in a box, as a debris flow's grains lie before release.
#include <cstdint>
#include <vector>

#include "core/vector.h"
#include "dem/particles.h"

namespace lahar::dem {

struct SizeClass {
  double radius = 0;  ///< m
  int count = 0;
  double density = 0;  ///< kg/m^3
  int material = 0;
};

struct PackingSpec {
  Vec3 lower = Vec3::Zero(), upper = Vec3::Zero();  ///< m, the box: floor at lower.z, side walls, gravity along -z
  std::vector<SizeClass> classes;
  std::uint64_t seed = 1;
  double target_height = 0;  ///< m, of the surface above the floor; if > 0 see pack()
};

/// What a packing turned out to be.
struct PackingReport {
  double height = 0;                ///< m, 99.5 % quantile of the spheres' tops above the floor
  double surface_height = 0;        ///< m, mean height at which vertical lines from above meet a sphere
  double solid_fraction = 0;        ///< volume of the spheres / (floor area x surface height)
  double max_relative_overlap = 0;  ///< largest overlap of a pair or with a wall / radius of the smaller sphere
};

/// Spheres of exactly the given radii, mixed at random and settled without friction onto the floor of the box: overlaps
/// below 1e-3 of a radius, at rest, fixed by the seed whatever the number of threads. The order is that of the classes.
/// If a target height is given and the mean surface stands higher, the packing is tapped a limited number of times;
/// what it then has reached is the caller's to check (measure_packing). Throws InputError if the spec makes no sense or
/// the spheres do not fit below the top of the box, but for the highest 0.5 % (PackingReport::height).
[[nodiscard]] std::vector<ParticleSpec> pack(const PackingSpec& spec);

[[nodiscard]] PackingReport measure_packing(const PackingSpec& spec, const std::vector<ParticleSpec>& spheres);

}  // namespace lahar::dem
