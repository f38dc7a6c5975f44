#pragma once
// What contact evaluation reads of a particle: three rows of eight numbers, arranged so that what a contact needs of
// its two spheres is the difference or the sum of their rows. A fourth row takes what the particle gets.
#include <cstdint>
#include <span>
#include <vector>

#include "core/row_field.h"
#include "dem/contact/contact_detection.h"
#include "dem/particles.h"

namespace lahar::dem {

/// The rows of particles that have a place among the parties of contacts (SI units; spin in rad/s):
/// - 0: position, velocity at mid-step, velocity at the end of the step (x, y);
/// - 1: velocity at the end (z), spin at mid-step, sum of the dampers of its contacts / mass, 1 if on a rail, spare,
///   radius;
/// - 2: radius x spin at mid-step, radius x spin at the end, inverse mass, radius;
/// - 3: not packed: for the sums of its contacts.
///
/// Velocities at the end are predicted with the last known force. One more place, the last, belongs to nobody: a sphere
/// that never touches.
class ContactBodies {
 public:
  /// To be called before `pack`, when the parties are new.
  void make_room(const Particles& particles, const ContactParties& parties);
  /// Packs the particles at `places`, which ascend. `particles.force` must still hold the sums of the last step, and
  /// `damping` the sums of its dampers (N s/m, per particle). Where velocities change within it, `mean` gives those
  /// that count as mid-step ones. Removed particles get a position that is not a number, so that they never touch.
  void pack(const Particles& particles, const ContactParties& parties, std::span<const std::uint32_t> places,
            const std::vector<double>& damping, double dt, const MeanMotion* mean = nullptr);
  /// Of two bodies of which one at least is on a rail, along `normal` (unit): sum of the inverse masses (1/kg), and of
  /// inverse mass x dampers (1/s). A body on a rail gives way along it alone: its inverse mass counts with the squared
  /// cosine.
  struct OnRails {
    double inverse_mass, damping_rate;
  };
  [[nodiscard]] OnRails on_rails(std::uint32_t owner_at, std::uint32_t partner_at, const Triple& normal) const;
  /// Numbers from one place to the next.
  static constexpr std::size_t kStride = 4 * kRow;
  [[nodiscard]] const double* data() const { return rows_[0]; }
  /// The row for the sums of a place.
  [[nodiscard]] double* sum(std::size_t place) { return rows_[4 * place + 3]; }
  [[nodiscard]] double* sums() { return rows_[3]; }

 private:
  struct RailedPlace {
    std::size_t place;
    Triple along;
  };

  [[nodiscard]] std::vector<RailedPlace>::const_iterator first_rail_from(std::size_t place) const;

  RowField rows_;
  std::vector<RailedPlace> rails_;  // ascending
};

}  // namespace lahar::dem
