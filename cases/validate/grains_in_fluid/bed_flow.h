#pragma once
// Flow through fixed beds of grains of a few cells, as a debris flow resolves them: periodic packs driven by a body
// force g, with F the drag without the buoyancy of the pressure gradient over 3 pi nu d U (U the superficial velocity),
// g = 18 nu U phi F / (d^2 (1 - phi)).
#include "cases/validate/grains_in_fluid/sphere_flow.h"

namespace lahar::validate {

struct Bed {
  double fraction = 0;          ///< solid
  int box = 0;                  ///< cells along an edge
  double diameter = 0;          ///< cells; exact for this fraction
  std::vector<Vec3> centres{};  ///< cells
};

/// A random pack in a box of so many diameters: the same pack on any cells. Above a volume fraction of 0.6 a jammed
/// one.
Bed make_bed(double fraction, int cells_per_diameter, int diameters);

/// Collision and eddies of debris flow scenes.
Immersion debris_immersion();

struct BedDrag {
  double reynolds, coefficient;  ///< U d / nu; F
};

/// Once the flow is steady; lattice units. `expected`: about what U will be, the velocity past the grains; these move
/// against it with `drift` times that.
template <class Real>
BedDrag drag_of_flow(const Bed& bed, double viscosity, double gravity, double expected, const Immersion& immersion,
                     double drift = 0);

/// Water through gravel of 5 cm under a hydraulic gradient of 0.1, at the time step of a scene whose fluid runs `speed`
/// m/s: 0.1 lu.
template <class Real>
BedDrag drag_of_gravel(const Bed& bed, double speed, const Immersion& immersion, double drift = 0);

}  // namespace lahar::validate
