// Water seeps steadily down a chute through a bed of spheres held in place that stands out of it: the spheres bear the
// water's weight along the chute (bed_in_chute.h).
#include <fmt/format.h>

#include "cases/validate/entry.h"
#include "cases/validate/grains_in_fluid/bed_in_chute.h"

namespace lahar::validate {

namespace {

/// What the bed bears too much, of the weight, while the flow is steady.
double borne_too_much(BedInChute b, double depth, double settle, double measure) {
  b.speed = 3, b.periodic = true, b.width = 0.36;
  b.spheres = Vec3i(static_cast<int>(b.length / (2 * BedInChute::radius) + 0.5), 6, 4);
  ChuteLedger ledger(b, {Vec3::Zero(), Vec3(b.length, b.width, depth)});
  ledger.run_until(settle);
  ledger.open();
  ledger.run_until(settle + measure);
  return ledger.made() / ledger.weight();
}

std::vector<Row> run(const Context& context) {
  constexpr double bar = 0.05;
  using enum lbm::BodyWeighting;
  const auto row = [&](const char* name, const BedInChute& b, double depth) {
    return absolute_row(fmt::format("{}, {:g} m of water: borne too much, of the weight along the chute", name, depth),
                        context.quick ? borne_too_much(b, depth, 0.1, 0.1) : borne_too_much(b, depth, 0.4, 0.4), 0,
                        bar);
  };
  const coupling::AveragedGrains averaged{.drag = coupling::BedDrag::gidaspow};
  if (context.quick)
    return {row("inertial", {.length = 0.48, .weighting = inertial}, 0.12),
            row("averaged", {.length = 0.48, .grains = averaged}, 0.12)};
  std::vector<Row> rows;
  for (const double depth : {0.12, 0.05}) {
    rows.push_back(row("inertial", {.length = 0.96, .weighting = inertial}, depth));
    rows.push_back(row("wall_distance", {.length = 0.96}, depth));
    rows.push_back(row("averaged", {.length = 0.96, .grains = averaged}, depth));
  }
  return rows;
}

}  // namespace

Entry seepage_with_surface() { return {"grains_in_fluid.seepage_with_surface", {"conservation of momentum", {}}, run}; }

}  // namespace lahar::validate
