// Water seeps steadily down a chute through a bed of spheres held in place that stands out of it: the spheres bear the
// water's weight along the chute (bed_in_chute.h).
#include <fmt/format.h>

#include "cases/validate/entry.h"
#include "cases/validate/grains_in_fluid/bed_in_chute.h"

namespace lahar::validate {

namespace {

/// What the bed bears and what of it is too much, of the weight, while the flow is steady.
struct Borne {
  double all, too_much;
};

Borne borne(BedInChute b, double depth, double settle, double measure) {
  b.speed = 3, b.periodic = true, b.width = 0.36;
  b.spheres = Vec3i(static_cast<int>(b.length / (2 * BedInChute::radius) + 0.5), 6, 4);
  ChuteLedger ledger(b, {Vec3::Zero(), Vec3(b.length, b.width, depth)});
  ledger.run_until(settle);
  ledger.open();
  ledger.run_until(settle + measure);
  return {ledger.on_bed() / ledger.weight(), ledger.made() / ledger.weight()};
}

std::vector<Row> run(const Context& context) {
  constexpr double bar = 0.05;
  using enum lbm::BodyWeighting;
  constexpr double bears = 0.8;  // at least: what the water still speeds up by is the rest
  std::vector<Row> rows;
  const auto ask = [&](const char* name, const BedInChute& b, double depth) {
    const std::string what = fmt::format("{}, {:g} m of water: ", name, depth);
    const double time = context.quick ? 0.1 : 0.4;
    const Borne found = borne(b, depth, time, time);
    rows.push_back(absolute_row(what + "borne too much, of the weight along the chute", found.too_much, 0, bar));
    rows.push_back(at_least_row(what + "borne, of the weight along the chute", found.all, bears));
  };
  const coupling::AveragedGrains averaged{.drag = coupling::BedDrag::gidaspow};
  if (context.quick) {
    ask("inertial", {.length = 0.48, .weighting = inertial}, 0.12);
    ask("averaged", {.length = 0.48, .grains = averaged}, 0.12);
    return rows;
  }
  for (const double depth : {0.12, 0.05}) {
    ask("inertial", {.length = 0.96, .weighting = inertial}, depth);
    ask("wall_distance", {.length = 0.96}, depth);
    ask("averaged", {.length = 0.96, .grains = averaged}, depth);
  }
  return rows;
}

}  // namespace

Entry seepage_with_surface() { return {"grains_in_fluid.seepage_with_surface", {"conservation of momentum", {}}, run}; }

}  // namespace lahar::validate
