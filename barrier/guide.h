#pragma once
// Guides: bars and shackles through which a cable slides along its own direction but not sideways (Li, Zhao & Kwan
// 2020, section 3.3: cables "can freely slide and deform along the axial direction ... but not along the radial
// direction").
#include <optional>
#include <vector>

#include "barrier/wire.h"
#include "dem/particles.h"

namespace lahar::barrier {

struct GuideStiffness {
  double stiffness = 1e7;      ///< N/m, against sideways motion
  double damping_ratio = 0.3;  ///< of critical for one bead, sideways
};

/// s, the longest stable step of beads of `mass` (kg) in guides. Their force is held over a step, from places and
/// velocities at its start: with a = omega dt the square of an oscillation's amplitude then changes by the factor
/// 1 - 2 zeta a + a^2/2, so that a may not exceed 4 zeta, and beyond a = 1/zeta the damper overshoots.
[[nodiscard]] double guide_time_step(const GuideStiffness& guide, double mass);

/// A damped spring from a point to the nearest point of a cable, as an eyelet without friction: its force is normal to
/// the cable wherever that runs, and is shared by the two beads beside that point according to how near they are
/// (moment and energy k d^2 / 2 are exact). A straight cable slides through without bumps, whether it meets its guide
/// straight or at an angle.
class Guides {
 public:
  explicit Guides(GuideStiffness stiffness = {}) : stiffness_(stiffness) {}

  /// A guide at `point` for an open cable.
  void add(const Wire& cable, const Vec3& point);

  /// Sets the external forces of the guided beads to what the guides do to them as they are now. To be called before
  /// every step: the beads of a guided cable may have no other external force.
  void apply(dem::Particles& particles);

  /// J, in the springs at the last call of apply.
  [[nodiscard]] double energy() const { return energy_; }
  /// The point of a guide in which there then was no more than the first or last bond of its cable: a dissipator that
  /// is drawn out by more than the length of cable beside it.
  [[nodiscard]] const std::optional<Vec3>& slipped_out() const { return slipped_out_; }

 private:
  struct Guide {
    dem::ParticleId first, last;  // beads: from the first to before the last
    Vec3 point;
  };
  /// Where a cable is nearest to its guide.
  struct Place {
    dem::ParticleId bead = 0;        // at the start of the segment
    double share = 0;                // of the segment
    Vec3 aside = Vec3::Zero();       // m, from the guide
    Vec3 direction = Vec3::UnitX();  // of the segment
  };
  static Place nearest(const Guide& guide, const dem::Particles& particles);

  GuideStiffness stiffness_;
  std::vector<Guide> guides_;
  std::vector<dem::ParticleId> loaded_;  // beads with a force since the last call
  double energy_ = 0;
  std::optional<Vec3> slipped_out_;
};

}  // namespace lahar::barrier
