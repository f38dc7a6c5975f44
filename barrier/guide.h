#pragma once
// Guides: bars and shackles through which a cable slides along its own direction but not sideways (Li, Zhao & Kwan
// 2020, section 3.3: cables "can freely slide and deform along the axial direction ... but not along the radial
// direction").
#include <vector>

#include "barrier/wire.h"
#include "dem/particles.h"

namespace lahar::barrier {

struct GuideStiffness {
  double stiffness = 1e7;      ///< N/m, against sideways motion
  double damping_ratio = 0.3;  ///< of critical for one bead, sideways
};

/// How much of a cable is in its guide.
struct GuideGrip {
  double grip = 0;  ///< sum of the weights: 1 for a straight cable, below that once its end slips out
  Vec3 point = Vec3::Zero();
};

/// A damped spring from the cable to the guide's axis. A bead at the distance s from the guide along its axis counts
/// with the weight 1 - |s| / spacing, so that the weights of evenly spaced beads add up to 1 wherever the cable stands:
/// it slides without bumps. The spring's energy w k r^2 / 2 is taken along the axis too. (Setting a bead back to its
/// place instead puts energy in with every bead that arrives.)
class Guides {
 public:
  explicit Guides(GuideStiffness stiffness = {}) : stiffness_(stiffness) {}

  /// A guide at `point` for a cable that runs along `axis` (unit) there; `spacing` of its beads in m.
  void add(const Wire& cable, const Vec3& point, const Vec3& axis, double spacing);

  /// Sets the external forces of the guided beads to what the guides do to them as they are now. To be called before
  /// every step: the beads of a guided cable may have no other external force.
  void apply(dem::Particles& particles);

  /// J, in the springs at the last call of apply.
  [[nodiscard]] double energy() const { return energy_; }
  /// N, the largest sideways force of a guide then.
  [[nodiscard]] double largest_force() const { return largest_force_; }
  /// The guide that then held least of its cable. A grip of much less than 1 means that a dissipator was drawn out by
  /// more than the length of cable beside it, and that nothing holds the cable here any more.
  [[nodiscard]] const GuideGrip& loosest() const { return loosest_; }

 private:
  struct Guide {
    dem::ParticleIndex first, last;  // beads
    Vec3 point, axis;
    double spacing;
  };

  GuideStiffness stiffness_;
  std::vector<Guide> guides_;
  std::vector<dem::ParticleIndex> held_;  // with a force since the last call
  double energy_ = 0, largest_force_ = 0;
  GuideGrip loosest_;
};

}  // namespace lahar::barrier
