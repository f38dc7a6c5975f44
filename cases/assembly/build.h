#pragma once
// From a scene to solvers.
#include <optional>

#include "barrier/net.h"
#include "cases/scene/scene.h"
#include "coupling/coupled_step.h"
#include "dem/solids.h"
#include "lbm/step/fluid.h"

namespace lahar::cases {

/// The fluid's options; the scene must have a fluid.
lbm::FluidOptions fluid_options(const scene::Scene& scene);

/// The liquid at the start.
std::vector<lbm::LiquidRegion> liquid_regions(const scene::Scene& scene);

/// Grains, barrier, walls and materials of a scene.
struct BuiltSolids {
  dem::Solids solids;
  std::optional<barrier::Net> net;
};

/// Whether grains are packed, or only stand for those that a checkpoint brings along.
enum class GrainStart { packed, placeholders };

/// Packs the grains and builds the barrier; the scene must have solids. Throws InputError if grains do not fit or the
/// net cannot be built.
BuiltSolids build_solids(const scene::Scene& scene, GrainStart grains = GrainStart::packed);

/// How fluid and solids act on each other.
coupling::CouplingOptions coupling_options(const scene::Scene& scene);

}  // namespace lahar::cases
