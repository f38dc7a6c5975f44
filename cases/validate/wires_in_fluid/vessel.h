#pragma once
// Water runs out of a tank through a round hole in a plate. The rim of the hole is the plate's own, or one ring of a
// net that touches it all round, so that the ring's opening is all that is left free.
#include <cmath>

#include "core/vector.h"

namespace lahar::validate {

/// Rings of the net are 300 mm wide with wire bundles of 30 mm: 1/9 of the clear opening.
constexpr double kWireOverOpening = 1.0 / 9.0;

enum class Rim { plate, wire_law, mapped_wire };

struct Vessel {
  double opening = 7;  ///< clear, cells
  Rim rim = Rim::plate;
  bool wide = true;  ///< the plate's hole reaches to the outside of the ring, else to its opening only
  int width = 48;
  double head = 40;  ///< cells, at the start, over the middle of the hole
  /// The second is whole periods of the sound that the opening of the hole leaves in the tank, 4 depths / 0.577.
  int settle = 600, measure = 1070;

  [[nodiscard]] double wire() const { return kWireOverOpening * opening; }
  [[nodiscard]] double hole() const { return wide ? opening + 2 * wire() : opening; }
  /// Middle of the hole: the centre of a cell.
  [[nodiscard]] double foot() const { return std::round(1.5 * opening) + 0.5; }
  [[nodiscard]] double middle() const { return std::floor(0.5 * width) + 0.5; }
  [[nodiscard]] double plate() const { return width; }
  [[nodiscard]] double thickness() const { return std::round(opening / 4); }
  [[nodiscard]] double gravity() const { return 0.01 / (2 * head); }  ///< the jet's speed is 0.1 lu
  [[nodiscard]] Vec3i cells() const {
    return {width + static_cast<int>(thickness() + 3 * opening), width, static_cast<int>(foot() + head) + 2};
  }
};

/// Means while it is measured, after the jet has formed.
struct Discharge {
  double per_speed = 0;        ///< discharge over sqrt(2 g h), cells^2
  double lattice_area = 0;     ///< cells in the plate's hole
  double jet_over_loss = 0;    ///< what is found beyond the plate over what the tank lost
  double area = 0, speed = 0;  ///< of the jet an opening behind the plate, cells^2, and over sqrt(2 g h)
  double push = 0;             ///< on the ring, over the pressure of the head on its shadow
  double audit = 0, ledger = 0;
};

/// Area, cells^2.
double circle(double diameter);

template <class Real>
Discharge run_out(const Vessel& vessel);

}  // namespace lahar::validate
