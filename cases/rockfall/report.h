#pragma once
// What a rockfall is held against, and its files.
#include <filesystem>
#include <vector>

#include "cases/rockfall/rockfall.h"
#include "cases/runner/summary.h"

namespace lahar::cases {

/// What must hold for any net and ball: nothing passes through anything, the energy balance closes, the ball turns
/// round, dissipators work, edge rings slide (or do not, if tied).
[[nodiscard]] std::vector<ResultCheck> rockfall_sanity(const RockfallResult& result, const Rockfall& rockfall);

/// What the paper reports of its own parameters (section 3.3).
[[nodiscard]] std::vector<ResultCheck> rockfall_paper_checks(const RockfallResult& result);

/// Charts rockfall_displacement and rockfall_energy, like the paper's Fig. 7; its figure only where it belongs to it.
void draw_rockfall(const std::filesystem::path& folder, const RockfallResult& result);

/// Runs rockfall into a folder. Returns false if it was interrupted; while the net settled there are no series, charts
/// and figures of a strike. Throws NumericalFailure, with the checks in the summary, if wires passed through each
/// other.
bool run_rockfall_to(const Rockfall& rockfall, const std::filesystem::path& folder, bool quiet, Summary& summary);

}  // namespace lahar::cases
