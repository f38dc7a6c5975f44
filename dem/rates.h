#pragma once
// Particles of two rates: slow ones (grains) take part in contacts among themselves and with walls at a long step,
// everything else acts at a short one.
#include <cstdint>
#include <vector>

#include "dem/particles.h"

namespace lahar::dem {

enum class Rate : std::uint8_t { all, fast, slow };

/// The contacts that a list or a sum is about. A pair is slow if both particles are, everything else is fast.
struct RateShare {
  Rate rate = Rate::all;
  const std::uint8_t* slow = nullptr;     ///< per particle, 1 for slow ones; not used with Rate::all
  const std::uint8_t* covered = nullptr;  ///< per particle, 1 for those in no pair at all (beads of smooth wires)

  /// Whether what acts on one particle alone (walls, gravity) belongs here.
  [[nodiscard]] bool single(std::size_t i) const { return rate == Rate::all || (slow[i] != 0) == (rate == Rate::slow); }
  /// Whether anything here is about a particle.
  [[nodiscard]] bool listed(std::size_t i) const { return rate != Rate::slow || slow[i] != 0; }
  /// Whether a particle may be in a pair.
  [[nodiscard]] bool paired(std::size_t i) const { return listed(i) && (covered == nullptr || covered[i] == 0); }
};

/// Velocities of particles averaged over a long step, in which they change.
struct MeanMotion {
  Vec3Field velocity, spin;  ///< m/s, rad/s
};

}  // namespace lahar::dem
