#pragma once
// Which segments of wire may touch which spheres and which runs of segments of other wires, and what these contacts
// remember.
#include <cstdint>
#include <vector>

#include "dem/contact/contact_state.h"
#include "dem/contact/neighbours.h"
#include "dem/particles.h"
#include "dem/wires/wire_chains.h"

namespace lahar::dem {

/// A possible contact of one segment of wire. Of two wires one gives the segment (a ring rather than an open wire,
/// which it may wrap; otherwise that of the lower body), the other one the run: segments that follow each other from
/// `partner` on. So a contact that moves along the run stays the same contact.
struct WireSlot {
  ParticleIndex wire = 0;     ///< bead of the segment
  ParticleIndex partner = 0;  ///< sphere, or first bead of the run
  std::uint32_t count = 0;    ///< segments of the run; 0 for a sphere
  ParticleIndex last = 0;     ///< bead of the run that it touched last; `partner` until then
  ContactHistory history;
  std::uint8_t touching = 0;  ///< 1 where history is in use
};

/// Slots in the order of their segments' ids, spheres before runs. Spheres are particles that belong to no wire, and
/// the ends of open wires that give segments, which so have caps for the others; runs have caps of their own. Particles
/// that at most two bonds join never touch.
class WireDetection {
 public:
  explicit WireDetection(NeighbourOptions options = {}) : options_(options), neighbours_(options) {}

  /// True if a particle has moved so far that the slots must be listed again.
  [[nodiscard]] bool outdated(const Particles& particles) const;
  /// Lists all slots anew. What touches keeps its history where it is listed again; returns the energy that the
  /// tangential springs of all others held, J.
  double rebuild(const Particles& particles, const WireChains& chains);
  /// The same slots of renumbered particles.
  void renumber(const Renumbering& change);

  [[nodiscard]] std::vector<WireSlot>& slots() { return slots_; }
  [[nodiscard]] const std::vector<WireSlot>& slots() const { return slots_; }
  /// State of a checkpoint: the list as it is, with all histories (wire_transfer.cpp).
  void transfer(Archive& archive, const Particles& particles, const WireChains& chains);

 private:
  void list_candidates(const Particles& particles, const WireChains& chains);
  void add_runs(const WireChains& chains, const Numbering& numbering, std::size_t first, std::size_t last);
  double carry_histories(const std::vector<WireSlot>& old, const WireChains& chains, const Numbering& numbering);
  void set_move_limits(const std::vector<double>& radius, const WireChains& chains);
  [[nodiscard]] Particles spheres_around_segments(const Particles& particles, const WireChains& chains) const;

  NeighbourOptions options_;
  NeighbourList neighbours_;
  std::vector<WireSlot> slots_;
  std::vector<std::uint64_t> candidates_;  // id of the segment, kind and id of the partner in one number
  Vec3Field built_at_;
  std::vector<double> move_limit2_;
};

}  // namespace lahar::dem
