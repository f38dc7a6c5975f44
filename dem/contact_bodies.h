#pragma once
// What contact evaluation reads of a particle: three lines of eight numbers, arranged so that what a contact needs of
// its two spheres is the difference or the sum of their lines.
#include <cstdint>

#include "dem/contact_detection.h"
#include "dem/lanes.h"
#include "dem/particles.h"

namespace lahar::dem {

/// The lines of the particles that have a place among the parties of contacts (SI units; spin in rad/s):
/// 0: position, velocity at mid-step, velocity at the end of the step (x, y)
/// 1: velocity at the end (z), spin at mid-step, spin at the end, radius
/// 2: radius x spin at mid-step, radius x spin at the end, inverse mass, 1 / radius
/// Velocities at the end are predicted with the last known force.
class ContactBodies {
 public:
  /// `particles.force` must still hold the sums of the last step. Where velocities change within it, `mean` gives those
  /// that count as mid-step ones. Removed particles get a position that is not a
  /// number, so that they never touch.
  void pack(const Particles& particles, const ContactParties& parties, double dt, const MeanMotion* mean = nullptr);
  [[nodiscard]] const double* operator[](std::size_t place) const { return lines_[3 * place]; }

 private:
  LineField lines_;
};

}  // namespace lahar::dem
