#pragma once
// The force in each bond of a barrier, seen against the flow: shows the chains that carry the load, as Fig. 12 of Li,
// Zhao & Kwan 2020, and how rings deform and slide, as its Fig. 11.
#include <cstddef>
#include <string>
#include <vector>

#include "cases/files/image.h"
#include "core/vector.h"
#include "dem/bonds/bonds.h"
#include "dem/particles.h"

namespace lahar::cases {

/// What is drawn, and on what.
struct ForceMap {
  const dem::Particles* particles = nullptr;
  const dem::Bonds* bonds = nullptr;
  std::size_t first_bond = 0, bond_count = 0;
  Vec3 origin = Vec3::Zero();    ///< m, lower left corner of the frame
  Vec3 across = Vec3::UnitY();   ///< unit, to the right in the picture
  Vec3 up = Vec3::UnitZ();       ///< unit
  double width = 0, height = 0;  ///< m, of the frame; a tenth of its width around it is drawn too
  double time_s = 0;
  std::string title{};
  const std::vector<Vec3>* before = nullptr;  ///< m, by id: earlier places of particles, drawn in grey; null for none
};

/// Lines between the ends of intact bonds, coloured and widened by the logarithm of the force's magnitude (axial and
/// shear), over the three decades that end above the largest force. Strong ones lie on top, and all on the same bonds
/// at their earlier places. Throws std::logic_error without bonds or for a frame without extent.
[[nodiscard]] Image force_map(const ForceMap& map);

}  // namespace lahar::cases
