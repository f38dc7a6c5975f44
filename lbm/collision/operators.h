#pragma once
// The collision operators that a fluid can have.

namespace lahar::lbm {

enum class CollisionOperator {
  central_moments,  ///< moments about the velocity, relaxed one by one (central_moments.h)
  bgk,              ///< one relaxation time for all (bgk.h)
  trt,              ///< two relaxation times, for even and odd parts (trt.h)
};

}  // namespace lahar::lbm
