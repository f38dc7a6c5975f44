#pragma once
// Two flows in periodic boxes that a grid cannot resolve at small viscosity: what an operator does with what is left
// over.
#include "cases/validate/fluid/flows.h"

namespace lahar::validate {

enum class PeriodicFlow {
  shear_layer,  ///< doubly periodic, u = U tanh(80 (y - 1/4)), v = U/20 sin 2 pi (x + 1/4) (Minion & Brown 1997), 2 L /
                ///< U
  vortex,       ///< three-dimensional Taylor-Green vortex, to t = 10
};

struct StabilityCase {
  PeriodicFlow flow = PeriodicFlow::shear_layer;
  lbm::CollisionOperator collision = lbm::CentralMoments{};
  double viscosity = 1e-6;  ///< lu
  double mach = 0.1;        ///< U / speed of sound
  double smagorinsky = 0;   ///< Cs
  int cells = 64;
};

struct Stability {
  double finished = 0;  ///< share of the time that was run before the watchdog stopped it, 1 if it did not
  double largest = 0;   ///< of kinetic energy, as a share of that of the start; infinite if it was stopped
  double rise = 0;      ///< largest of energy above its lowest until then, of the start's; infinite if stopped
};

/// Runs the flow in the given precision. Nothing feeds it: its energy must not rise.
Stability run_periodic(const StabilityCase& c, Precision precision);

}  // namespace lahar::validate
