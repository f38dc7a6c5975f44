#pragma once
// How far dissipators may be drawn out with a time step. A longer bond turns its beads with a longer lever and asks for
// a shorter step (docs/decisions/0029); a run whose step is longer stops.
#include <optional>
#include <vector>

#include "cases/scene/scene.h"
#include "dem/bonds/bonds.h"
#include "dem/particles.h"

namespace lahar::cases {

/// The free beads at the ends of dissipators, each with the bonds that hold it.
class DrawnOutDissipators {
 public:
  /// `dissipators` are numbers of bonds.
  DrawnOutDissipators(const std::vector<std::size_t>& dissipators, const dem::Particles& particles,
                      const dem::Bonds& bonds);

  /// s: what these beads allow with all dissipators drawn out by `elongation` (m) and other bonds as long as they are.
  /// Infinity without such beads.
  [[nodiscard]] double time_step(double elongation) const;
  /// m: up to where the dissipators may be drawn out with steps of `time_step` (s), at most `furthest` (m).
  [[nodiscard]] double elongation(double time_step, double furthest) const;

 private:
  /// A bead, number 0, and what its bonds lead to, along x. Bond k leads to particle k + 1.
  struct HeldBead {
    dem::Particles particles;
    dem::Bonds bonds;
  };
  static HeldBead held_bead(dem::ParticleIndex bead, const dem::Particles& particles, const dem::Bonds& bonds);

  std::vector<HeldBead> beads_;
};

/// m: the elongation at which the dissipators of a scene's cables activate. The scene must have some.
double activation_elongation(const scene::Scene& scene);

/// Where a step no longer holds.
struct DrawnOutLimit {
  double elongation = 0;        ///< m
  double force = 0;             ///< N, of a dissipator that is drawn out so far
  double further = 0, far = 0;  ///< m: one length of a bond beyond the activation, and ten
  double step_for_further = 0;  ///< s, that holds as far as `further`
  double step_for_far = 0;      ///< s, likewise
};

/// The elongation at which steps of `time_step` (s) no longer hold, if that comes early: less than the length of a bond
/// beyond the activation of the dissipators, at less than twice their activation force. Nothing if it comes later,
/// where the barrier as built asks for a shorter step, without dissipators, and for barriers that cannot be tried.
std::optional<DrawnOutLimit> early_limit(const scene::Scene& scene, double time_step);

/// The largest solids.bond_safety of two digits whose steps are no longer than `time_step` (s).
double bond_safety_for(const scene::Scene& scene, double time_step);

/// The largest number of two digits that is no larger than a positive one.
double two_digits_down(double number);

}  // namespace lahar::cases
