// Checks of grain-size distributions: each makes sense, and box and cells can carry its sizes.
#include "cases/assembly/check_gradings.h"

#include <fmt/format.h>

#include <cmath>

#include "cases/assembly/grain_sizes.h"

namespace lahar::scene {
namespace {

constexpr double kMostGrains = 1e6;   // of one grading
constexpr double kLeastShare = 0.01;  // of a distribution that its cut-offs keep
constexpr double kLeastGrains = 0.5;  // rounds to one

/// Whether the grains are as many as a run can hold, and one at least.
void check_count(double volume, double mean, const std::string& path, const std::string& what, Findings& findings) {
  const double count = volume / mean;
  if (count < kLeastGrains)
    findings.mistake(path, fmt::format("{}: {} holds {:.2g} of a grain, expected at least one: more mass, or another "
                                       "distribution",
                                       path, what, count));
  else if (!(count <= kMostGrains))
    findings.mistake(path,
                     fmt::format("{}: {} holds {:.3g} grains, expected at most {:g}: less mass, or a coarser lower "
                                 "end",
                                 path, what, count, kMostGrains));
}

/// Returns whether an amount is given.
bool check_amount(const Packing& packing, const GrainAmount& amount, const std::string& path, Findings& findings) {
  if (amount.mass > 0 && amount.solid_fraction != GrainAmount{}.solid_fraction) {
    findings.mistake(path + ".solid_fraction",
                     path + ".solid_fraction with mass_kg, which says how much there is, expected one of the two");
    return true;
  }
  if (amount.mass > 0 || packing.target_height > 0) return true;
  findings.mistake(path + ".mass_kg", path +
                                          ".mass_kg is 0 and the packing has no target_height_m to fill to, expected "
                                          "one of the two");
  return false;
}

void check_log_normal(const Packing& packing, const LogNormalGrains& g, const std::string& path, Findings& findings) {
  if (g.largest <= g.smallest)
    return findings.mistake(path + ".largest_diameter_m",
                            fmt::format("{}.largest_diameter_m is {:g}, expected above smallest_diameter_m, {:g}", path,
                                        g.largest, g.smallest));
  const dem::LogNormalSizes sizes = distribution_of(g);
  if (const double share = dem::kept_share(sizes); share < kLeastShare)
    return findings.mistake(path + ".smallest_diameter_m",
                            fmt::format("{}: the cut-offs keep {:.2g} of the distribution, expected at least {:g}",
                                        path, share, kLeastShare));
  if (check_amount(packing, g.amount, path, findings))
    check_count(solid_volume(packing, g.amount, g.density), dem::mean_volume(sizes), path, "the distribution",
                findings);
}

/// Returns what is wrong with a sieve curve, "" if nothing is.
std::string curve_fault(const std::vector<SievePoint>& curve) {
  for (std::size_t k = 0; k < curve.size(); ++k) {
    const SievePoint& p = curve[k];
    if (!(p.opening > 0)) return fmt::format("has entry {} with the opening {:g}, expected above 0", k + 1, p.opening);
    if (k > 0 && p.opening <= curve[k - 1].opening)
      return fmt::format("has the opening {:g} after {:g}, expected rising openings", p.opening, curve[k - 1].opening);
    if (k > 0 && p.passing < curve[k - 1].passing)
      return fmt::format("falls from {:g} to {:g} at the opening {:g}, expected rising percentages",
                         curve[k - 1].passing, p.passing, p.opening);
  }
  if (curve.front().passing != 0)
    return fmt::format("begins with {:g} percent, expected 0: nothing says how small these grains are",
                       curve.front().passing);
  if (curve.back().passing != 100)
    return fmt::format("ends with {:g} percent, expected 100: nothing says how large the rest is",
                       curve.back().passing);
  return {};
}

void check_sieved(const Packing& packing, const SievedGrains& g, const std::string& path, Findings& findings) {
  const std::string key = path + ".passing_percent";
  if (const std::string fault = curve_fault(g.passing); !fault.empty()) return findings.mistake(key, key + " " + fault);
  if (!check_amount(packing, g.amount, path, findings)) return;
  for (std::size_t k = 1; k < g.passing.size(); ++k) {
    const SievePoint &low = g.passing[k - 1], &high = g.passing[k];
    if (high.passing > low.passing && findings.sound({key}))
      check_count(solid_volume(packing, g.amount, g.density) * (high.passing - low.passing) / 100,
                  dem::mean_volume(low.opening, high.opening), key,
                  fmt::format("the fraction from {:g} to {:g} m", low.opening, high.opening), findings);
  }
}

/// Diameters that fit into the box, and that feel the water.
void check_room(const Scene& scene, const Packing& packing, double smallest, const std::string& low_key, double largest,
                const std::string& high_key, Findings& findings) {
  const double room = (packing.upper - packing.lower).minCoeff();
  if (largest > room && findings.sound({high_key}))
    findings.mistake(high_key, fmt::format("{} reaches up to {:g} m, expected at most the smallest extent of the box, "
                                           "{:g}",
                                           high_key, largest, room));
  check_mapped_diameter(scene, smallest, low_key, "goes down to", findings);
}

}  // namespace

void check_mapped_diameter(const Scene& scene, double diameter, const std::string& key, const std::string& is,
                           Findings& findings) {
  const bool resolved = scene.coupling.enabled && scene.fluid.enabled && scene.coupling.grains == GrainFluid::resolved;
  if (resolved && diameter < scene.fluid.cell_size * (1 - 1e-9) && findings.sound({key, "fluid", "coupling"}))
    findings.mistake(key, fmt::format("{} {} {:g} m, expected at least a cell of the fluid, {:g}: smaller grains do "
                                      "not feel the water",
                                      key, is, diameter, scene.fluid.cell_size));
}

void check_gradings(const Scene& scene, std::size_t i, Findings& findings) {
  const Packing& packing = scene.grains.packings[i];
  for (std::size_t k = 0; k < packing.log_normal.size(); ++k) {
    const LogNormalGrains& g = packing.log_normal[k];
    const std::string path = fmt::format("grains.packing[{}].log_normal[{}]", i, k);
    check_log_normal(packing, g, path, findings);
    check_room(scene, packing, g.smallest, path + ".smallest_diameter_m", g.largest, path + ".largest_diameter_m",
               findings);
  }
  for (std::size_t k = 0; k < packing.sieved.size(); ++k) {
    const SievedGrains& g = packing.sieved[k];
    const std::string path = fmt::format("grains.packing[{}].sieve_curve[{}]", i, k), key = path + ".passing_percent";
    check_sieved(packing, g, path, findings);
    check_room(scene, packing, g.passing.front().opening, key, g.passing.back().opening, key, findings);
  }
}

}  // namespace lahar::scene
