#pragma once
// What a ring pull is held against, and its files.
#include <filesystem>
#include <vector>

#include "cases/ring_pull/ring_pull.h"
#include "cases/runner/summary.h"

namespace lahar::cases {

/// Displacement of the end of the first stage in the paper's section 3.1, m.
inline constexpr double paper_transition = 0.140;

/// Held against ring theory, the ledger and the paper.
[[nodiscard]] std::vector<ResultCheck> ring_pull_checks(const PullCurve& curve, const RingPull& ring);

/// Largest relative difference of two curves' forces at every hundredth of the stroke from the tenth on.
[[nodiscard]] double largest_difference(const PullCurve& a, const PullCurve& b, double stroke);

/// Charts ring_pull: force over displacement, with the paper's figure where it belongs to the ring, and
/// ring_pull_first_stage: its beginning enlarged.
void draw_ring_pull(const std::filesystem::path& folder, const PullCurve& curve, const RingPull& ring);

/// Runs ring_pull into a folder. Returns false if it was interrupted: then there is the curve until there, no more.
bool run_ring_pull(const RingPull& ring, const std::filesystem::path& folder, bool quiet, Summary& summary);

}  // namespace lahar::cases
