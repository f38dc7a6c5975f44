#pragma once
// The collision operators that a fluid can have.
//
// An operator is an empty struct with
//   name, meaning           its word in a scene file and what it says of itself in docs/scene_reference.md
//   bounds_stress           whether it takes the bounds of stress_limit.h: it keeps density, velocity and the
//                           deviator of the stress alone
//   equilibrium_order       of what it relaxes to (equilibrium.h)
//   takes_flow_laws         whether it is compiled for the flow laws of lbm/rheology
//   stable_without_eddies   whether it is at small viscosities, without a Smagorinsky constant
//   collide(f, m, force, viscosity)   the collision of a cell or a pack of cells
//   odd_time(tau)           only where the odd part of the non-equilibrium relaxes at a time of its own (trt.h)
#include <string_view>
#include <variant>

#include "lbm/collision/bgk.h"
#include "lbm/collision/central_moments.h"
#include "lbm/collision/trt.h"

namespace lahar::lbm {

/// All of them. Who stands here is a choice of `fluid.collision`, has kernels in the sweep and runs through the
/// property suite.
using CollisionOperator = std::variant<CentralMoments, Bgk, Trt>;

[[nodiscard]] inline std::string_view name(const CollisionOperator& collision) {
  return std::visit([](const auto& o) { return o.name; }, collision);
}
[[nodiscard]] inline bool bounds_stress(const CollisionOperator& collision) {
  return std::visit([](const auto& o) { return o.bounds_stress; }, collision);
}
[[nodiscard]] inline EquilibriumOrder equilibrium_order(const CollisionOperator& collision) {
  return std::visit([](const auto& o) { return o.equilibrium_order; }, collision);
}
[[nodiscard]] inline bool takes_flow_laws(const CollisionOperator& collision) {
  return std::visit([](const auto& o) { return o.takes_flow_laws; }, collision);
}
[[nodiscard]] inline bool stable_without_eddies(const CollisionOperator& collision) {
  return std::visit([](const auto& o) { return o.stable_without_eddies; }, collision);
}

}  // namespace lahar::lbm
