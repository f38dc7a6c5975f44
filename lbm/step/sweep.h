#pragma once
// Collide and stream one block: gather the incoming populations, collide vectors of cells, send the outgoing ones.
#include <array>
#include <string>

#include "lbm/collision/coverage_weight.h"
#include "lbm/collision/operators.h"
#include "lbm/grid/block.h"
#include "lbm/rheology/rheology.h"
#include "lbm/step/streaming.h"

namespace lahar::lbm {

/// Uniform parameters of a sweep, lattice units.
struct SweepParameters {
  CollisionOperator collision = CentralMoments{};
  CoverageWeightLaw coverage_weight;  ///< B of the drag that bodies wrote into a cell
  /// Central moments keep the place of a body's surface (collision/central_moments_at_bodies.h).
  bool third_moments_at_bodies = false;
  SolidOperator solid_operator = kSolidOperator;
  bool keep_velocity = true;    ///< for wires: writes BodyFields::velocity_x, _y, _z
  double tau = 1;               ///< relaxation time of the viscous moments
  double smagorinsky = 0;       ///< Cs, 0 is off
  RheologyParameters rheology;  ///< in place of tau where the flow law is not Newtonian
  std::array<double, 3> gravity{0, 0, 0};
  Parity parity;
};

/// What was seen in the wet cells of a block in a step.
struct SweepNote {
  int wet = 0;              ///< cells
  int limited = 0;          ///< cells whose stress was limited
  int exposed = 0;          ///< interface cells with a bound on their relaxation rate
  int held_back = 0;        ///< cells whose speed was limited
  double speed_square = 0;  ///< of the fastest before it was limited, lu; infinite if one is not a number
};

/// One step of one block. `around` are the 27 blocks by neighbour_slot, null where there is none.
template <class Real>
using BlockSweep = SweepNote (*)(Block<Real>& block, const std::array<Block<Real>*, 27>& around,
                                 const SweepParameters& p);

/// The kernel for a block that is plain liquid (`mixed` false) or holds other cells too, with bodies or without.
template <class Real>
BlockSweep<Real> choose_sweep(const SweepParameters& p, bool mixed, bool bodies);

}  // namespace lahar::lbm
