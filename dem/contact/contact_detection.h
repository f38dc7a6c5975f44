#pragma once
// Which contacts may exist and what they remember: slots for sphere-sphere and sphere-wall pairs, and the geometry of a
// contact.
#include <cstdint>
#include <vector>

#include "core/geometry.h"
#include "core/row_field.h"
#include "dem/contact/contact_energy_sums.h"
#include "dem/contact/contact_state.h"
#include "dem/contact/neighbours.h"
#include "dem/particles.h"

namespace lahar::dem {

/// What the contacts of all slots remember: a row of numbers per slot, as active ones lie apart.
class SlotHistories {
 public:
  /// In a row, and two more that are spare: tangential displacement (m), stiffness, normal force, damping force.
  static constexpr std::size_t kNumbers = 6;

  void clear(std::size_t slots) { rows_.assign(slots, 0.0); }
  [[nodiscard]] double* row(std::size_t k) { return rows_[k]; }
  [[nodiscard]] ContactHistory operator[](std::size_t k) const {
    const double* h = rows_[k];
    return {{h[0], h[1], h[2]}, h[3], h[4], h[5]};
  }
  void set(std::size_t k, const ContactHistory& h) {
    const Triple& u = h.tangential_displacement;
    store_aligned(rows_[k], Row<double>{u.x, u.y, u.z, h.tangential_stiffness, h.normal_force, h.damping_force, 0, 0});
  }
  /// Row k becomes what row from[k] was.
  void reorder(const std::vector<std::uint32_t>& from);

 private:
  RowField rows_;
};

/// Possible contacts in CSR form: row i holds partners, particles in the order of their ids or walls in that of their
/// numbers; a contact's memory lies in its slot.
struct ContactSlots {
  std::vector<std::uint32_t> offset;   ///< per particle
  std::vector<std::uint32_t> owner;    ///< per slot: the particle of its row
  std::vector<std::uint32_t> partner;  ///< per slot
  SlotHistories history;
  std::vector<std::uint8_t> touching;  ///< 1 where history is in use
  bool rolls = false;                  ///< whether `rolling` is kept
  std::vector<Triple> rolling;         ///< rad, elastic rotation of rolling resistance; empty unless `rolls`

  [[nodiscard]] std::size_t size() const { return partner.size(); }
  /// The same slots of renumbered particles. Returns for each slot where it was.
  std::vector<std::uint32_t> renumber(const Renumbering& change, bool with_walls);
  /// State of a checkpoint: rows and histories (solids_transfer.cpp).
  void transfer(Archive& archive, std::size_t particles, std::size_t partners);
};

/// Visits all slots in the order of their particles' ids: visit(slot).
template <class Visit>
void for_each_slot_by_id(const ContactSlots& slots, const Numbering& numbering, const Visit& visit) {
  for (std::size_t id = 0; id + 1 < slots.offset.size(); ++id) {
    const ParticleIndex i = numbering.index(id);
    for (std::uint32_t k = slots.offset[i]; k < slots.offset[i + 1]; ++k) visit(k);
  }
}

/// A touching contact by the names of its sides.
struct StoredContact {
  ParticleId particle = 0;
  std::uint32_t partner = 0;  ///< id of a particle, or number of a wall
  bool with_wall = false;
  ContactHistory history;
  Triple rolling{};
};

/// Particles that one thread takes at a time; fixed, so that sums do not depend on the number of threads.
inline constexpr std::size_t kContactChunk = 128;

/// The particles that are in any pair slot. A place is a position in `particle`.
struct ContactParties {
  struct Partner {
    std::uint32_t slot, place;
  };
  std::vector<ParticleIndex> particle;        ///< per place, ascending
  std::vector<std::uint32_t> owner, partner;  ///< per slot: places of its two particles
  std::vector<std::uint32_t> first_place;     ///< per chunk of particles, and the number of places at the end
  std::vector<std::uint32_t> first_partner;   ///< per chunk of particles, into `as_partner`, and its size at the end
  std::vector<Partner> as_partner;            ///< all slots by the chunk of their partner, in it by id of their owner
};

/// Slots for all pairs that may touch before the next rebuild. Histories are keyed on the pair, so that they outlive a
/// rebuild; what a step computes does not depend on when the lists were built.
///
/// Two lists, one inside the other (as in molecular dynamics: Pall & Hess 2013, Comput. Phys. Commun. 184:2641): the
/// neighbour list with a wide skin comes from cells and holds long; the slots are its pairs within a narrow skin, found
/// by running through it. Of them the contact loop takes those that touch (active_contacts.h). The narrow skin widens
/// where particles are fast and thins where they rest. What particles have moved since the neighbour list was built and
/// what the slots let them move may not exceed the wide skin together.
class ContactDetection {
 public:
  explicit ContactDetection(NeighbourOptions options = {}) : neighbours_(options) {}

  /// True if the slots must be listed again: by `rebuild`, or by `refresh` where the neighbour list holds.
  [[nodiscard]] bool outdated(const Particles& particles);
  /// Whether the neighbour list has every pair that may touch before slots that are listed now are outdated.
  [[nodiscard]] bool neighbours_hold(const Particles& particles) const {
    return !neighbours_.outdated(particles, 1 - narrow_share_);
  }
  /// From now on slots keep what rolling resistance remembers. To be called before the first list is built.
  void remember_rolling() {
    for (ContactSlots* slots : {&pairs_, &walls_, &previous_pairs_, &previous_walls_}) slots->rolls = true;
  }
  /// Builds all lists of the contacts in `share` anew and carries the histories over. Positions must be finite. Returns
  /// what the tangential and rolling springs held of contacts that touched and are not listed any more, as those of
  /// removed particles.
  ContactTally rebuild(const Particles& particles, const Walls& walls, const PairSet& excluded,
                       const RateShare& share = {});
  /// Lists the slots anew from the neighbour list, which must hold.
  ContactTally refresh(const Particles& particles, const RateShare& share = {});

  [[nodiscard]] ContactSlots& pairs() { return pairs_; }
  [[nodiscard]] const ContactSlots& pairs() const { return pairs_; }
  [[nodiscard]] ContactSlots& wall_contacts() { return walls_; }
  [[nodiscard]] const ContactSlots& wall_contacts() const { return walls_; }
  [[nodiscard]] const NeighbourList& neighbours() const { return neighbours_; }
  [[nodiscard]] const ContactParties& parties() const { return parties_; }
  /// Counts `refresh`, also those in `rebuild`.
  [[nodiscard]] std::int64_t refreshes() const { return refreshes_; }

  /// The same lists of renumbered particles. Returns for each wall slot where it was. The particles are those after it.
  std::vector<std::uint32_t> renumber(const Particles& particles, const Renumbering& change);

  /// All touching contacts with their histories, in the order of ids.
  [[nodiscard]] std::vector<StoredContact> stored_contacts(const Particles& particles) const;
  /// State of a checkpoint: the lists as they are, with all histories (solids_transfer.cpp). A list that was built
  /// later would differ where a bond has broken or a particle was removed since it was built.
  void transfer(Archive& archive, const Particles& particles, std::size_t walls, const RateShare& share);
  /// Puts stored histories into the present lists; contacts that are not listed there are an error.
  void restore(const Particles& particles, const std::vector<StoredContact>& contacts);

 private:
  struct Reach {
    double x, y, z, reach;  // m; not a number where removed
  };

  void list_pairs(const Particles& particles);
  void list_row(std::size_t i, const Numbering& numbering, std::vector<std::uint32_t>& row) const;
  void list_parties(const Particles& particles);
  void list_walls(const Particles& particles, const Walls& walls, const RateShare& share);
  void remember_positions(const Particles& particles, const RateShare& share);
  void set_move_limits(const Particles& particles, const RateShare& share);

  NeighbourList neighbours_;
  ContactSlots pairs_, walls_, previous_pairs_, previous_walls_;
  ContactParties parties_;
  std::vector<Reach> reach_;  // during refresh
  std::vector<std::vector<std::uint32_t>> chunk_rows_;
  std::vector<std::uint32_t> place_, chunk_next_;  // during refresh
  Vec3Field listed_at_;
  std::vector<double> move_limit2_;
  double narrow_share_ = 0.1;  // of the skin
  std::int64_t refreshes_ = 0, asked_ = 0;
};

}  // namespace lahar::dem
