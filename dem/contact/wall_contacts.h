#pragma once
// Contacts of spheres with walls: those that touch are gathered into lanes.
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

/// R* of a sphere of some radius (m) on a wall, m: sqrt(R' R'') of the principal radii of the gap (as of wires,
/// dem/wires/wire_contact.h), with 1/R' = 1/r + 1/R on a ball of radius R, both ways, and across a cylinder, 1/r - 1/R
/// in a bore, and the radius itself along a cylinder and on all else. A cylinder's ends count as its side, so that the
/// force is the slope of an energy wherever a sphere rolls over its rim. A bore that fits closer than a tenth of the
/// sphere's curvature counts as one that does not.
[[nodiscard]] double effective_radius_on(const Shape& wall, double radius);

class WallContacts {
 public:
  /// To be called when the slots are new.
  void resize(std::size_t slots, const Numbering& numbering) {
    answers_.resize(slots);
    booked_.assign(numbering.by_id() ? 0 : slots, {});
  }
  /// The slots are new, but nothing is evaluated until the next step: those that were there before keep their answers.
  void keep_answers(const ContactSlots& before, const ContactSlots& now);
  void clear() { answers_.clear(); }
  /// The slots stand elsewhere: slot k was from[k].
  void renumber(const std::vector<std::uint32_t>& from) { reorder(answers_, from); }

  /// The wall slots of a chunk of particles: evaluates them and advances their histories by `dt` (s). Needs the forces
  /// of the step before in `particles`; `damping` and `mean`: see ContactBodies::pack.
  void evaluate(const ContactLawChoice& law, const Particles& particles, const std::vector<double>& damping,
                ContactDetection& contacts, const Walls& walls, const ContactMaterials& materials, double dt,
                const MeanMotion* mean, std::size_t chunk, ContactTally& tally);
  /// Adds what came out to the `force` and `torque` of the chunk's particles, the dampers to `damping`.
  void add_to(Particles& particles, std::vector<double>& damping, const ContactDetection& contacts,
              std::size_t chunk) const;
  /// Where indices are not ids: the energies of the chunk of particles with these ids, in the order in which `evaluate`
  /// sums them up where they are.
  void tally_by_id(const Numbering& numbering, const ContactDetection& contacts, double dt, std::size_t chunk,
                   ContactTally& tally) const;

  /// Force of all particles on one wall in the last evaluation, N.
  [[nodiscard]] Vec3 force_on_wall(const Particles& particles, const ContactDetection& contacts,
                                   std::uint32_t wall) const;
  /// Its moment about the origin of the coordinates, N m; each force acts where its sphere is nearest to the wall.
  [[nodiscard]] Vec3 moment_on_wall(const Particles& particles, const ContactDetection& contacts, const Walls& walls,
                                    std::uint32_t wall) const;

 private:
  struct Answer {
    Triple force{}, torque{};  // on the particle
    double power = 0;          // W, of a moving wall on the particle
    double damper = 0;         // N s/m
  };
  struct Booked {  // energies of a slot
    ContactTally law, rolling;
  };
  struct Work;
  struct Batch;

  template <ContactLaw L>
  void evaluate_with(const L& law, const Work& work, std::size_t chunk, ContactTally& tally);
  template <ContactLaw L>
  void evaluate_batch(const L& law, const Work& work, Batch& batch, ContactTally& tally);

  std::vector<Answer> answers_;  // per wall slot
  std::vector<Booked> booked_;   // per wall slot, only where indices are not ids
};

}  // namespace lahar::dem
