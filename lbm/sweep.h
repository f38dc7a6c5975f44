#pragma once
// Collide and stream one block: gather the incoming populations, collide vectors of cells, send the outgoing ones.
#include <array>
#include <string>

#include "lbm/block.h"
#include "lbm/collision/coverage.h"
#include "lbm/rheology/rheology.h"
#include "lbm/streaming.h"

namespace lahar::lbm {

enum class CollisionOperator { central_moments, bgk, trt };

/// Uniform parameters of a sweep, lattice units.
struct SweepParameters {
  CollisionOperator collision = CollisionOperator::central_moments;
  CoverageLaw coverage;  ///< B of what bodies wrote into a cell
  SolidOperator solid_operator = SolidOperator::faded;
  double tau = 1;               ///< relaxation time of the viscous moments
  double smagorinsky = 0;       ///< Cs, 0 is off
  RheologyParameters rheology;  ///< in place of tau where the flow law is not Newtonian
  std::array<double, 3> gravity{0, 0, 0};
  Parity parity;
};

/// One step of one block. `around` are the 27 blocks by neighbour_slot, null where there is none.
template <class Real>
using BlockSweep = void (*)(Block<Real>& block, const std::array<Block<Real>*, 27>& around, const SweepParameters& p);

/// The kernel for a block that is plain liquid (`mixed` false) or holds other cells too, with bodies or without.
template <class Real>
BlockSweep<Real> choose_sweep(const SweepParameters& p, bool mixed, bool bodies);

}  // namespace lahar::lbm
