#pragma once
// Contacts of spheres with walls: those that touch are gathered eight at a time.
#include <cstdint>
#include <vector>

#include "core/geometry.h"
#include "dem/contact/contact_detection.h"
#include "dem/contact/contact_energy_sums.h"
#include "dem/contact/contact_lanes.h"
#include "dem/contact/contact_materials.h"
#include "dem/contact/pair_contacts.h"
#include "dem/particles.h"

namespace lahar::dem {

class WallContacts {
 public:
  void resize(std::size_t slots) { answers_.resize(slots); }
  void clear() { answers_.clear(); }

  /// The wall slots of a chunk of particles: evaluates them and advances their histories by `dt` (s). Needs the forces
  /// of the step before in `particles`; `mean`: see ContactBodies::pack.
  void evaluate(const ContactLawChoice& law, const Particles& particles, ContactDetection& contacts, const Walls& walls,
                const ContactMaterials& materials, double dt, const MeanMotion* mean, std::size_t chunk,
                ContactTally& tally);
  /// Adds what came out to the `force` and `torque` of the chunk's particles.
  void add_to(Particles& particles, const ContactDetection& contacts, std::size_t chunk) const;

  /// Force of all particles on one wall in the last evaluation, N.
  [[nodiscard]] Vec3 force_on_wall(const ContactDetection& contacts, std::uint32_t wall) const;
  /// Its moment about the origin of the coordinates, N m; each force acts where its sphere is nearest to the wall.
  [[nodiscard]] Vec3 moment_on_wall(const Particles& particles, const ContactDetection& contacts, const Walls& walls,
                                    std::uint32_t wall) const;

 private:
  struct Answer {
    Triple force{}, torque{};  // on the particle
  };
  struct Work;
  struct Batch;

  template <ContactLaw L>
  void evaluate_with(const L& law, const Work& work, std::size_t chunk, ContactTally& tally);
  template <ContactLaw L>
  void evaluate_batch(const L& law, const Work& work, Batch& batch, ContactTally& tally);

  std::vector<Answer> answers_;  // per wall slot
};

}  // namespace lahar::dem
