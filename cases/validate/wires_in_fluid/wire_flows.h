#pragma once
// Wires that are held in a stream: what the entries on wires, screens, nets and rings share. Lattice units. Everything
// is periodic; the stream starts uniform, and a body force stands for the pressure that would keep it up. It is
// measured before the wakes come round.
#include <array>
#include <vector>

#include "cases/validate/entry.h"
#include "core/vector.h"
#include "coupling/coupling_options.h"
#include "dem/solids.h"
#include "lbm/rheology/rheology.h"

namespace lahar::validate {

/// A straight wire, or a closed ring where `diameter_of_ring` is given.
struct HeldWire {
  Vec3 start = Vec3::Zero(), end = Vec3::Zero();  ///< the end may lie beyond a periodic face
  double ring_diameter = 0;                       ///< of the centre-line; the ring lies across x, around `start`
};

/// Wires of one diameter whose beads are held, about a diameter apart.
dem::Solids held_wires(const std::vector<HeldWire>& wires, double diameter);

struct WireStream {
  double diameter = 1;  ///< cells
  double reynolds = 100;
  double speed = 0.1;                  ///< lu
  lbm::RheologyOptions rheology = {};  ///< lattice units
  Vec3 direction = Vec3::UnitX();
  Vec3i cells{64, 64, 8};
  std::vector<HeldWire> wires;
  double expected_drag = 0;  ///< lu, of all wires: what the body force balances
  double travel = 48;        ///< cells that the stream moves; the last third is measured
  bool resolved = false;     ///< as immersed bodies instead of the closure, as scenes have them by default
  double radius_shift = coupling::kRadiusShift;  ///< cells, of the immersed bodies
};

struct WireLoad {
  double drag = 0, side = 0;  ///< lu, mean force of the stream on all wires, along the stream and across it
  double spread = 0;          ///< (largest - smallest)/mean drag while measured
  double speed = 0;           ///< lu, mean of the box while measured
  double audit = 0;           ///< |what the fluid's momentum misses| / what was exchanged
  double cell_updates = 0;
  double tau = 0;
};

/// Runs the stream in the context's precision.
WireLoad run_stream(const WireStream& stream, const Context& context);

/// Drag coefficient of a single straight wire across the stream, and the law at the speed that the wire sees. In a box
/// of the given width w the stream beside the wake is faster: by Cd d/(4 w) at the wire (half of the deficit of its
/// wake, continuity).
struct WireCoefficient {
  double found = 0, law = 0;
};
WireCoefficient coefficient_of(const WireStream& stream, const WireLoad& load, double length, double width);

/// cylinder_cd.csv (Sucker & Brauer 1975) at any Reynolds number.
double cylinder_law(double reynolds);

}  // namespace lahar::validate
