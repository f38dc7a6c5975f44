#pragma once
// What a scene may choose of the coupling, and the defaults of library and scenes.
#include <optional>
#include <variant>

namespace lahar::coupling {

/// Added to the radius (cells) at which the fluid comes to rest, with BodyWeighting::wall_distance and inertial; the
/// volume stays that of the body. In creeping flow, fitted on arrays of spheres (docs/decisions/0021); and where the
/// flow past the body is fast beside the cells, fitted on a packed bed (docs/decisions/0054).
inline constexpr double kRadiusShift = -0.06, kRadiusShiftFast = -0.2;

/// The shift between them, cells: for a velocity of the flow past the body U with U dx / nu = `cell_reynolds`.
constexpr double radius_shift_at(double cell_reynolds) {
  constexpr double half_way = 2.5;
  return kRadiusShift + (kRadiusShiftFast - kRadiusShift) * cell_reynolds / (cell_reynolds + half_way);
}

/// Grains displace and stop the fluid cell by cell: immersed moving boundary (grains/resolved_exchange.h).
struct ResolvedGrains {
  double radius_shift = kRadiusShift;
};

/// Drag laws of the averaged exchange (grains/bed_drag.h).
enum class BedDrag { di_felice, gidaspow, beetstra };

/// Grains feel the flow averaged over a length, and have no wall in the cells (grains/averaged_exchange.h).
struct AveragedGrains {
  double averaging_length = 0.15;  ///< m; no less than a cell
  BedDrag drag = BedDrag::di_felice;
  bool beads_as_grains = false;  ///< beads of wires feel the law of the grains around, but fill no space among them
};

/// Grains and fluid do not feel each other.
struct UncoupledGrains {};

/// How grains and fluid exchange momentum (grains/grain_exchange.h).
using GrainExchangeChoice = std::variant<ResolvedGrains, AveragedGrains, UncoupledGrains>;

/// Between grains, and between grains and walls, that are closer than the cells resolve.
enum class GrainFilms {
  none,
  lubrication,  ///< grains/lubrication.h
};

/// Wires that are not mapped as bodies.
enum class ThinWires {
  uncoupled,
  drag_law,  ///< beads feel drag, and the cells the opposite (wires/wire_drag.h)
};

/// Wires that the cells resolve are bodies (wires/wire_map.h).
struct MappedWires {
  double from_diameter;  ///< cells, of the thinnest that are
  double radius_shift = kRadiusShift;
};

struct CouplingOptions {
  GrainExchangeChoice grains = ResolvedGrains{};
  GrainFilms films = GrainFilms::none;
  ThinWires thin_wires = ThinWires::drag_law;
  std::optional<MappedWires> mapped_wires = std::nullopt;
  int substeps = 1;  ///< DEM steps in a fluid step; where that adapts they stay no longer than those of the first
};

}  // namespace lahar::coupling
