#include "dem/packing/packing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "core/check.h"
#include "core/number_text.h"
#include "core/sphere.h"
#include "dem/packing/relaxer.h"

namespace lahar::dem {

namespace {

constexpr double kFinalOverlap = 5e-4;     // largest overlap / radius to stop at
constexpr double kBearableOverlap = 1e-3;  // the same, above which a packing is refused: it would fly apart
constexpr int kMaxTaps = 10, kMaxTapsOfJams = 40;

void check(const PackingSpec& spec) {
  const Vec3 box = spec.upper - spec.lower;
  if (!(box.minCoeff() > 0)) throw InputError("packing: the box must have a positive size in every direction");
  double volume = 0;
  for (const SizeClass& c : spec.classes) {
    if (!(c.radius > 0) || c.count < 0 || !(c.density > 0))
      throw InputError("packing: a size class needs a positive radius and density and a count of at least 0");
    if (c.count > 0 && 2 * c.radius > box.minCoeff())
      throw InputError("packing: spheres of radius " + number_text(c.radius) + " m are wider than the box");
    volume += c.count * sphere_volume(c.radius);
  }
  constexpr double kDensest = 0.7405;  // of equal spheres; random packings of any sizes used here stay below
  if (volume > kDensest * box.prod())
    throw InputError("packing: the spheres' volume of " + number_text(volume) + " m^3 does not fit a box of " +
                     number_text(box.prod()) + " m^3");
}

/// Orders each class along columns of cells a few spheres wide: neighbours in space then are near each other in memory.
void sort_along_cells(const PackingSpec& spec, std::vector<ParticleSpec>& spheres) {
  double largest = 0;
  for (const ParticleSpec& s : spheres) largest = std::max(largest, s.radius);
  const auto cell = [&](const ParticleSpec& s) {
    const Vec3 c = ((s.position - spec.lower) / (4 * largest)).array().floor();
    return std::array<double, 3>{c.x(), c.y(), c.z()};
  };
  auto first = spheres.begin();
  for (const SizeClass& c : spec.classes) {
    const auto last = first + c.count;
    std::stable_sort(first, last, [&](const auto& a, const auto& b) { return cell(a) < cell(b); });
    first = last;
  }
}

}  // namespace

std::vector<ParticleSpec> pack(const PackingSpec& spec) {
  check(spec);
  std::vector<ParticleSpec> spheres;
  for (const SizeClass& c : spec.classes)
    for (int k = 0; k < c.count; ++k) {
      ParticleSpec s;
      s.radius = c.radius, s.density = c.density, s.material = c.material;
      spheres.push_back(s);
    }
  if (spheres.empty()) return spheres;
  Relaxer relaxer(spec, spheres);
  relaxer.place_at_random();
  relaxer.spread();
  const auto settle = [&](double fall_times) {
    relaxer.settle(1.0, fall_times);
    relaxer.settle(0.1, 1);  // less weight on the same contacts: overlaps shrink, the arrangement stays
    relaxer.relieve(kFinalOverlap);
  };
  settle(5);
  const double speed = 0.5 * std::sqrt(Relaxer::kGravity * relaxer.largest_radius());
  const auto tap_while = [&](int most, double harder, const auto& needed) {
    for (int k = 0; k < most && needed(); ++k) {
      relaxer.tap(speed * (1 + k * harder));
      settle(1);
    }
  };
  // Spheres that are jammed side by side find no way up without a kick that lifts those above them.
  tap_while(kMaxTapsOfJams, 0.25, [&] { return relaxer.max_relative_overlap() > kBearableOverlap; });
  tap_while(kMaxTaps, 0, [&] { return spec.target_height > 0 && relaxer.surface_height() > spec.target_height; });
  if (const double overlap = relaxer.max_relative_overlap(); overlap > kBearableOverlap)
    throw InputError("packing: settled spheres still overlap by " + number_text(overlap) +
                     " of a radius, expected fewer, or a larger box");
  for (std::size_t i = 0; i < spheres.size(); ++i) spheres[i].position = spec.lower + relaxer.position()[i];
  sort_along_cells(spec, spheres);
  const double top = relaxer.height(), limit = spec.upper.z() - spec.lower.z();
  if (top > limit)
    throw InputError("packing: the settled spheres stand " + number_text(top) + " m high in a box of " +
                     number_text(limit) + " m");
  return spheres;
}

PackingReport measure_packing(const PackingSpec& spec, const std::vector<ParticleSpec>& spheres) {
  PackingReport report;
  if (spheres.empty()) return report;
  double volume = 0;
  for (const ParticleSpec& s : spheres) volume += sphere_volume(s.radius);
  Relaxer relaxer(spec, spheres);
  relaxer.list_near();
  report.height = relaxer.height();
  report.surface_height = relaxer.surface_height();
  report.solid_fraction = volume / ((spec.upper - spec.lower).head<2>().prod() * report.surface_height);
  report.max_relative_overlap = relaxer.max_relative_overlap();
  return report;
}

}  // namespace lahar::dem
