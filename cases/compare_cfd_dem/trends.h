#pragma once
// Whether quantities go from flow to flow as the paper says.
#include <string>
#include <vector>

#include "cases/compare_cfd_dem/comparison.h"

namespace lahar::study {

/// Whether a quantity goes the paper's way: from every flow to every faster one, in three of four pairs of flows, or
/// not.
enum class Agreement { yes, mostly, no, unknown };
const char* name_of(Agreement agreement);

/// A trend that the paper states over its flows.
struct Trend {
  std::string statement, sweep, coupling, preset;
  std::size_t flows = 0;  ///< that have the quantity
  /// Programs (commits) that these were run by: between them presets and physics may have changed, and the trend with
  /// them.
  std::size_t programs = 0;
  double measure = 0;  ///< what decides, by the kind of the statement (`trends`); NaN where there are too few flows
  Agreement agrees = Agreement::unknown;
};
/// Of every sweep with at least three flows of a preset and coupling (study's reading, whole width, lowest seed). What
/// decides: of what rises or falls Kendall's rank correlation with the release distance; of what levels off from L
/// = 6.35 m on the slope from there on over that before (none for the paper: yes below a quarter, mostly below a half);
/// of what is the greater part in all flows its least share.
std::vector<Trend> trends(const std::vector<CaseResult>& results);
/// trend,sweep,coupling,preset,flows,programs,measure,agrees
std::string trends_csv(const std::vector<Trend>& all);

}  // namespace lahar::study
