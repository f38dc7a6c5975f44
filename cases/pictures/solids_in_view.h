#pragma once
// Which capsules stand for the particles and bonds of a scene, and how they are coloured.
#include <vector>

#include "cases/pictures/capsule.h"
#include "cases/pictures/colour.h"
#include "cases/pictures/picture.h"

namespace lahar::cases {

struct SolidsInView {
  std::vector<Capsule> capsules;
  std::vector<Colour> colours;                         ///< linear, one per capsule
  std::vector<bool> metallic;                          ///< wire rather than stone, one per capsule
  double smallest_diameter = 0, largest_diameter = 0;  ///< of the grains, m; 0 without grains
  double full_speed = 0;                               ///< m/s at the end of the speed ramp
  double full_tension = 0;                             ///< N at the end of the tension ramp; 0 without bonds
};

/// Grains and single beads become spheres; each intact bond becomes a capsule between its beads, coloured by tension.
/// Removed particles are left out.
[[nodiscard]] SolidsInView solids_in_view(const PictureScene& scene, const PictureStyle& style);

}  // namespace lahar::cases
