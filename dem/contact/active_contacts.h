#pragma once
// Which slots have work in a step: of a net that hangs, or of grains that fly, nine in ten do not touch.
#include <cstdint>
#include <span>
#include <vector>

#include "dem/contact/contact_detection.h"
#include "dem/particles.h"

namespace lahar::dem {

/// The slots whose spheres touch, and those that did a step before, which leave what their springs hold. All others
/// answer zero and remember nothing. Lists are kept by chunks of particles (kContactChunk) and ascend as the slots do.
class ActiveContacts {
 public:
  /// Makes room; to be called when slots are new.
  void note_slots(const ContactDetection& contacts);
  /// Finds the slots that a chunk's particles own, from the positions of this step. For all chunks, before
  /// `find_places`.
  void find_slots(const Particles& particles, const ContactDetection& contacts, std::size_t chunk);
  /// Finds the chunk's particles that are in such slots, and where they are the partner.
  void find_places(const ContactDetection& contacts, std::size_t chunk);

  /// That particles of a chunk own.
  [[nodiscard]] std::span<const std::uint32_t> slots(std::size_t chunk) const {
    return of(chunk, slots_, &Chunk::slots);
  }
  /// Active slots are numbered: those of a chunk one after the other, from `first_number` on. Numbers stay below that
  /// of all slots.
  [[nodiscard]] std::size_t first_number(std::size_t chunk) const { return chunks_[chunk].slots.first; }
  [[nodiscard]] std::uint32_t slot(std::size_t number) const { return slots_[number]; }
  /// Places (ContactParties) of a chunk's particles in any active slot.
  [[nodiscard]] std::span<const std::uint32_t> places(std::size_t chunk) const {
    return of(chunk, places_, &Chunk::places);
  }
  struct Partner {
    std::uint32_t number, place;  ///< of the slot; of its partner
  };
  /// Active slots whose partner is of a chunk, in the order of ContactParties::as_partner.
  [[nodiscard]] std::span<const Partner> as_partner(std::size_t chunk) const {
    return of(chunk, as_partner_, &Chunk::as_partner);
  }

 private:
  struct List {
    std::size_t first = 0, count = 0;
  };
  struct Chunk {
    List slots, places, as_partner;
  };
  template <class T>
  [[nodiscard]] std::span<const T> of(std::size_t chunk, const std::vector<T>& all, List Chunk::*list) const {
    const List& l = chunks_[chunk].*list;
    return std::span(all).subspan(l.first, l.count);
  }

  std::vector<Chunk> chunks_;
  std::vector<std::uint32_t> slots_, places_;  // of all chunks, each with room for all that it could have
  std::vector<Partner> as_partner_;
  std::vector<std::uint32_t> number_;  // per slot: its number and one, 0 where it is not active
};

}  // namespace lahar::dem
