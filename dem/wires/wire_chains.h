#pragma once
// Which beads form wires: chains of intact bonds between beads of one body, closed (rings) or open (cables).
#include <cstdint>
#include <limits>
#include <vector>

#include "dem/bonds/bonds.h"
#include "dem/particles.h"

namespace lahar::dem {

/// Chains of beads, and who stands before and behind whom. A bead belongs to a wire while it has an intact bond to a
/// bead of its body and radius. Bodies in which a bead ever had three such bonds are meshes, not wires.
class WireChains {
 public:
  static constexpr ParticleIndex none = std::numeric_limits<ParticleIndex>::max();

  /// From the bonds that are intact now. The direction of a chain follows from its beads' ids.
  void build(const Bonds& bonds, const Particles& particles);

  /// The same chains of renumbered particles.
  void renumber(const Renumbering& change);

  /// 1 for each particle that is part of a wire.
  [[nodiscard]] const std::vector<std::uint8_t>& covered() const { return covered_; }
  [[nodiscard]] bool is_end(std::size_t i) const {
    return covered_[i] != 0 && (before_[i] == none || behind_[i] == none);
  }
  [[nodiscard]] bool closed(std::size_t i) const { return closed_[i] != 0; }
  [[nodiscard]] ParticleIndex before(std::size_t i) const { return before_[i]; }
  [[nodiscard]] ParticleIndex behind(std::size_t i) const { return behind_[i]; }
  /// Whether at most two intact bonds lead from one particle to the other: such never touch.
  [[nodiscard]] bool near(ParticleIndex i, ParticleIndex j) const;

 private:
  void find_near(const Bonds& bonds, std::size_t particles);
  void order_chain(ParticleIndex from, const Numbering& numbering);

  std::vector<std::uint8_t> covered_, closed_;
  std::vector<ParticleIndex> before_, behind_;
  std::vector<std::uint32_t> near_offset_;  // per particle, CSR
  std::vector<ParticleIndex> near_;         // ascending
};

}  // namespace lahar::dem
