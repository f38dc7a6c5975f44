#pragma once
// What a dissipator test is held against, and its files.
#include <filesystem>
#include <vector>

#include "cases/energy_dissipator/energy_dissipator.h"
#include "cases/runner/summary.h"

namespace lahar::cases {

/// Held against the given law (0.5 % in force and slope), the area under the curve and the ledger.
[[nodiscard]] std::vector<ResultCheck> dissipator_checks(const BrakeCurve& curve, const EnergyDissipator& brake);

/// Chart of force over elongation, there and back, with the law.
void draw_dissipator(const std::filesystem::path& file, const BrakeCurve& curve, const EnergyDissipator& brake);

/// Runs energy_dissipator into a folder. Returns false if it was interrupted: then there is the curve until there, no
/// more.
bool run_energy_dissipator(const EnergyDissipator& brake, const std::filesystem::path& folder, Summary& summary);

}  // namespace lahar::cases
