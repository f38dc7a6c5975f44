#pragma once
// Contacts between spheres: as many slots at a time as there are lanes, then summed per particle in a fixed order.
#include <array>
#include <cstdint>
#include <vector>

#include "dem/contact/active_contacts.h"
#include "dem/contact/contact_bodies.h"
#include "dem/contact/contact_detection.h"
#include "dem/contact/contact_energy_sums.h"
#include "dem/contact/contact_lanes.h"
#include "dem/contact/contact_laws.h"
#include "dem/contact/contact_materials.h"
#include "dem/particles.h"

namespace lahar::dem {

/// A particle's sum is taken over the slots that it owns, in the order of their partners' ids, then over those where it
/// is the partner, in the order of their owners' ids. Only active slots are evaluated, others would add zeros: the sum
/// depends neither on which of them are listed nor on threads nor on where particles stand.
class PairContacts {
 public:
  /// Notes what stays the same while the slots stay. To be called when they are new.
  void note_slots(const Particles& particles, const ContactDetection& contacts, const ContactMaterials& materials);
  /// Finds the active slots and packs their spheres (see ContactBodies::pack).
  void pack(const Particles& particles, const ContactDetection& contacts, const std::vector<double>& damping, double dt,
            const MeanMotion* mean);
  /// The active slots owned by a chunk of particles: evaluates them, advances their histories by `dt` and adds to the
  /// sums of the owners. To be called for all chunks, in any order or at once, before `add_partners`.
  void evaluate(const ContactLawChoice& law, ContactDetection& contacts, const ContactMaterials& materials, double dt,
                std::size_t chunk, ContactTally& tally);
  /// Completes the sums of a chunk of particles and adds them to `force` and `torque`, those of their dampers to
  /// `damping`.
  void add_partners(Particles& particles, std::vector<double>& damping, const ContactDetection& contacts,
                    std::size_t chunk, ContactTally& tally);

  /// Where indices are not ids: the energies of the chunk of particles with these ids, in the order in which `evaluate`
  /// and `add_partners` sum them up where they are: of dampers (and rolling), then, after the walls, of slip.
  void tally_damping(const Numbering& numbering, const ContactDetection& contacts, std::size_t chunk,
                     ContactTally& tally) const;
  void tally_friction(std::size_t chunk, ContactTally& tally) const;

 private:
  struct Batch;  // where the numbers of the slots in the lanes lie
  struct Tail;
  struct Arms;

  template <ContactLaw L>
  void evaluate_with(const L& law, ContactDetection& contacts, const ContactMaterials& materials, double dt,
                     std::size_t chunk, ContactTally& tally);
  template <ContactLaw L>
  void evaluate_batch(const L& law, const Batch& at, const ContactMaterials& materials, double dt, ContactTally& tally);
  void gather(ContactLanes& contacts, Arms& arms, const Batch& at, const ContactMaterials& materials) const;
  void give_way_along_rails(ContactLanes& contacts, const Batch& at) const;
  void prefetch(const std::uint32_t* slot, const double* history) const;
  [[nodiscard]] Lanes3 roll(const ContactLanes& contacts, const ContactHistoryOf<Lanes>& history,
                            const Lanes& stiffness_before, const Lanes& damper, const Batch& at,
                            const ContactMaterials& materials, double dt, ContactTally& tally) const;

  ActiveContacts active_;
  ContactBodies bodies_;
  std::vector<std::uint16_t> material_;               // per slot, into ContactMaterials
  RowField on_partner_;                               // per active slot: force, torque, friction work, damper
  std::vector<std::uint32_t> owner_at_, partner_at_;  // per slot: where the rows of its two particles begin
  bool one_material_ = false;                         // the same in all slots
  // Only where indices are not ids:
  struct Energies {
    double damping = 0, friction = 0;  // J, of the slots that a particle owns, and of those where it is the partner
  };
  std::vector<ParticleId> id_of_place_;
  std::vector<Energies> energies_;        // by id
  std::vector<ContactTally> of_rolling_;  // per slot, where it resists rolling
};

}  // namespace lahar::dem
