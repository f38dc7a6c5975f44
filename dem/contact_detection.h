#pragma once
// Which contacts may exist and what they remember: slots for sphere-sphere and sphere-wall pairs, and the geometry of a
// contact.
#include <cstdint>
#include <vector>

#include "core/geometry.h"
#include "dem/contact/contact_state.h"
#include "dem/neighbours.h"
#include "dem/particles.h"

namespace lahar::dem {

/// Possible contacts in CSR form: row i holds partners (a particle or a wall) in ascending order; a contact's memory
/// lies in its slot.
struct ContactSlots {
  std::vector<std::uint32_t> offset;   ///< per particle
  std::vector<std::uint32_t> partner;  ///< per slot
  std::vector<ContactHistory> history;
  std::vector<std::uint8_t> touching;  ///< 1 where history is in use

  [[nodiscard]] std::size_t size() const { return partner.size(); }
  /// State of a checkpoint, given the rows (solids_transfer.cpp).
  void transfer_histories(Archive& archive);
};

/// A touching contact by the names of its sides.
struct StoredContact {
  ParticleIndex particle = 0;
  std::uint32_t partner = 0;  ///< particle or wall
  bool with_wall = false;
  ContactHistory history;
};

/// Slots for all pairs that may touch before the next rebuild. Histories are keyed on the pair, so that they outlive a
/// rebuild; what a step computes does not depend on when the lists were built.
class ContactDetection {
 public:
  explicit ContactDetection(NeighbourOptions options = {}) : neighbours_(options) {}

  [[nodiscard]] bool outdated(const Particles& particles) const { return neighbours_.outdated(particles); }
  /// Builds the lists anew and carries the histories over. Positions must be finite.
  void rebuild(const Particles& particles, const Walls& walls, const PairSet& excluded);

  [[nodiscard]] ContactSlots& pairs() { return pairs_; }
  [[nodiscard]] const ContactSlots& pairs() const { return pairs_; }
  [[nodiscard]] ContactSlots& wall_contacts() { return walls_; }
  [[nodiscard]] const ContactSlots& wall_contacts() const { return walls_; }
  [[nodiscard]] const NeighbourList& neighbours() const { return neighbours_; }

  /// Slots in which particle j is the partner: slot_of_partner()[partner_offset()[j] ...], ascending.
  [[nodiscard]] const std::vector<std::uint32_t>& partner_offset() const { return partner_offset_; }
  [[nodiscard]] const std::vector<std::uint32_t>& slot_of_partner() const { return slot_of_partner_; }

  /// All touching contacts with their histories, ordered.
  [[nodiscard]] std::vector<StoredContact> stored_contacts() const;
  /// State of a checkpoint: the lists as they are, with all histories (solids_transfer.cpp). A list that was built
  /// later would differ where a bond has broken or a particle was removed since it was built.
  void transfer(Archive& archive, const Particles& particles);
  /// Puts stored histories into the present lists; contacts that are not listed there are an error.
  void restore(const std::vector<StoredContact>& contacts);

 private:
  void list_walls(const Particles& particles, const Walls& walls);
  void list_partners(std::size_t particles);

  NeighbourList neighbours_;
  ContactSlots pairs_, walls_, previous_pairs_, previous_walls_;
  std::vector<std::uint32_t> partner_offset_, slot_of_partner_;
};

}  // namespace lahar::dem
