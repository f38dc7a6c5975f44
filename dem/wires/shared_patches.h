#pragma once
// A patch may lie on several segments of a wire that follow each other. Each of them is a contact of its own
// (wire_patch.h), and Hertz' elastic forces add up over them, but dampers and tangential springs do not: of a segment
// with the share p of the patch's integral, whose equivalent overlap is p^(2/5) of the patch's,
//   damper   ~ sqrt(S m*) times its lever squared, S ~ p^(1/5), lever ~ p^(2/5), so that equal ones add up to p^(-1/2);
//   spring   ~ S: up to p^(-4/5).
// With the damping ratio times sqrt(p W_i/W) and the shear modulus times p^(4/5) they add up to those of one contact
// (by the linear law, which has no shear modulus, springs add up as they are); W_i and W are the inverse masses that
// yield to the segment's contact and to the whole patch's.
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "dem/wires/wire_chains.h"
#include "dem/wires/wire_contact.h"
#include "dem/wires/wire_detection.h"

namespace lahar::dem {

/// A slot that touches now.
struct WireTouch {
  std::uint32_t slot = 0;
  WireContact contact;
  double integral = 0;     ///< I, m^3
  double depth = 0;        ///< m, deepest overlap
  ParticleIndex last = 0;  ///< bead of the run at the deepest place
  double share = 1;        ///< p
  double yields = 1;       ///< W_i/W
};

/// Which slots lie on one patch, and what each has of it: found anew in every step.
class SharedPatches {
 public:
  /// Finds which slots may lie on one patch, after they were listed: those of segments that follow each other and that
  /// join them with the same sphere, or with runs that share a bead.
  void list(const std::vector<WireSlot>& slots, const WireChains& chains);

  /// Sets share and yields of all slots that touch, in their order.
  void share_out(std::span<WireTouch* const> touching, const Particles& particles);

 private:
  std::uint32_t root_of(std::uint32_t k);
  void share_out_one(std::span<WireTouch* const> patch, const Particles& particles);

  std::vector<std::pair<std::uint32_t, std::uint32_t>> beside_;  // slots, ascending
  // Of the step under way:
  std::vector<std::uint32_t> place_;  // by slot: among those that touch
  std::vector<std::uint32_t> up_;     // by place: another of the same patch, or itself
  std::vector<WireTouch*> patch_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> by_root_;
};

}  // namespace lahar::dem
