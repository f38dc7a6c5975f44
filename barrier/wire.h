#pragma once
// A wire as the DEM sees it: beads on a centre-line, neighbours joined by bonds. Rings are closed wires, cables open
// ones.
#include <cstdint>
#include <numbers>
#include <optional>
#include <vector>

#include "barrier/polyline.h"
#include "dem/bonds/bonds.h"
#include "dem/particles.h"

namespace lahar::barrier {

/// What all beads of a wire share.
struct WireProperties {
  double diameter = 0;       ///< m, of a bead
  double density = 0;        ///< kg/m^3, of a bead
  int material = 0;          ///< index into dem::Materials
  double mass_scale = 1;     ///< inertial over gravitational mass of a bead
  double inertia_scale = 1;  ///< moment of inertia of a bead over that of a sphere of its inertial mass

  /// kg, inertial
  [[nodiscard]] double bead_mass() const {
    return mass_scale * density * std::numbers::pi / 6 * diameter * diameter * diameter;
  }
};

/// A range of beads, by id, and of bonds. Bond k joins beads k and k + 1; the last bond of a closed wire closes it.
struct Wire {
  dem::ParticleId first_bead = 0;
  std::uint32_t beads = 0;
  std::size_t first_bond = 0;
  std::size_t bonds = 0;
  bool closed = false;
  std::int32_t body = -1;
};

struct WireSpec {
  Polyline line;  ///< bead centres, m
  WireProperties properties;
  int sort = 0;                               ///< bond sort of all bonds ...
  int dissipator_sort = -1;                   ///< ... but of those listed next
  std::vector<std::size_t> dissipator_bonds;  ///< numbers within the wire
  std::vector<std::size_t> fixed_beads;       ///< numbers within the wire
  std::int32_t body = 0;
  std::optional<Vec3> rail{};  ///< unit: all beads that are not fixed move along this direction only
};

/// A sort of bonds as thick as the wire, where it states no thickness of its own.
[[nodiscard]] dem::BondSort with_wire_radius(dem::BondSort sort, double wire_diameter);

/// Adds the beads and, at rest, the bonds.
Wire add_wire(const WireSpec& spec, dem::Particles& particles, dem::Bonds& bonds);

/// The centre-line of a wire as it lies now.
[[nodiscard]] Polyline centre_line(const Wire& wire, const dem::Particles& particles);

/// False once a bond of the wire has broken.
[[nodiscard]] bool is_whole(const Wire& wire, const dem::Bonds& bonds);

/// Widest spacing of bead centres, in bead diameters, that holds other chains of the same beads back. At sqrt(2) two
/// crossing chains pass through each other without any overlap: bead between beads.
inline constexpr double largest_spacing = 1.4142135623730951;

}  // namespace lahar::barrier
