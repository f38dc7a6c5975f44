#pragma once
// The ledger of the volume that grains displace.
//
// Liquid and grains share the cells ("total fill": the mass of a wet cell includes the grain's share). Populations of
// wet cells carry the mixture, so that a grain that moves inside the liquid pushes it by itself. A grain that moves
// between a gas cell and a wet cell is not carried by any population; its change of volume in wet cells is added to the
// interface cells at its waterline, as they have room or liquid for it (docs/decisions/0045), and what those are too
// few for to the cells near by (lbm/free_surface/isolated_liquid.h). Cells full of grains hold
// no liquid: what flows into or out of the interface cells among them goes to the same place (docs/decisions/0041). So
// a grain entering the water raises the level by its volume, and
//   liquid = sum of wet masses - sum over grains of their volume in wet cells
// is conserved exactly, together with what is on its way (docs/decisions/0003).
//
// Averaged grains fill with the level instead (docs/decisions/0064): a wet cell holds of a grain its part in the cell
// times the fill level, so that a grain's wet volume follows the surface, also where that alone moves. No conversion
// books anything for them: a mapping is compared with the former one as it was.
#include <vector>

#include "coupling/grains/grain_map.h"

namespace lahar::coupling {

/// A mapping: measure_former before GrainMap::update, then begin, measure_block for all blocks with grains; and book,
/// unless the grains were put into liquid that was filled around them.
template <class Real>
class DisplacedVolume {
 public:
  /// `fills_with_level`: as GrainExchange's.
  explicit DisplacedVolume(bool fills_with_level = false) : fills_with_level_(fills_with_level) {}

  /// The wet volume of the former mapping: under the cell types of now, as conversions have booked their part already;
  /// where grains fill with the level as it was, since conversions leave them alone.
  void measure_former(const lbm::Fluid<Real>& fluid, const GrainMap<Real>& map);

  void begin(const GrainMap<Real>& map);
  /// After the block's fields are written. In parallel over blocks. Interface cells that a grain covers are set full.
  void measure_block(lbm::Fluid<Real>& fluid, const GrainMap<Real>& map, std::size_t block);

  /// Gives each grain's change of wet volume, and what the interface cells that it covers gained, to its other
  /// interface cells; cells near by take it where there are none (lbm/free_surface/isolated_liquid.h). They fill the
  /// void that a grain leaves that was removed.
  void book(lbm::Fluid<Real>& fluid, const GrainMap<Real>& map);

  /// Volume of a mapped grain inside wet cells, in cells.
  [[nodiscard]] double wet_volume_of(const MappedGrain& grain) const;
  /// What the last mapping gave to interface cells for a grain that fills with the level, lu; below 0 where it took.
  /// Mass has the velocity of the cell that gets it: that momentum comes from nowhere (docs/decisions/0074).
  struct Handed {
    double mass = 0;
    Vec3 momentum = Vec3::Zero();
  };
  [[nodiscard]] Handed handed_by(const MappedGrain& grain) const;

  /// State of a checkpoint.
  void transfer(Archive& archive);

 private:
  /// Of a pair, cells. Sums over interface cells that are not covered: of eps, of eps times what is missing to a full
  /// cell, and of eps times the liquid in the cell.
  struct Share {
    double wet = 0;  ///< over wet cells
    double surface = 0, room = 0, liquid = 0;
    double drift = 0;  ///< mass that covered interface cells gained in the last step
    Handed handed = {};
  };
  /// Of the former mapping: a grain's wet volume, cells, and the block with most of it.
  struct Former {
    double wet = 0;
    lbm::BlockIndex block = lbm::kNoBlock;
  };
  /// What a grain hands to its interface cells.
  struct Handout {
    double per_able = 0;  ///< mass per eps times room, liquid or 1
    bool alike = false;   ///< by eps alone
  };

  void make_room_for(const GrainMap<Real>& map);
  void measure_again(const lbm::Fluid<Real>& fluid, const GrainMap<Real>& map);
  static void settle_covered(const lbm::Block<Real>& block, const GridSphere<Real>& sphere, const Vec3i& lowest,
                             Share& share);
  void hand_out(lbm::Fluid<Real>& fluid, const GrainMap<Real>& map, std::size_t block);

  bool fills_with_level_;
  std::vector<Share> shares_;        // by pair
  std::vector<Former> former_;       // by id; {} between mappings
  std::vector<Handout> handouts_;    // by grain
  std::vector<double> isolated_;     // by grain: what its cells are too few for, per wet volume
  std::vector<double> isolated_in_;  // the same by block index, lu
};

extern template class DisplacedVolume<float>;
extern template class DisplacedVolume<double>;

}  // namespace lahar::coupling
