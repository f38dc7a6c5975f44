// A sheet of water that runs into a bed of spheres held in place: how much momentum it makes or loses (bed_in_chute.h).
#include <fmt/format.h>

#include "cases/validate/entry.h"
#include "cases/validate/grains_in_fluid/bed_in_chute.h"

namespace lahar::validate {

namespace {

constexpr double kDepth = 0.08;     // m
constexpr double kDuration = 0.16;  // s: no drop has left through the top by then

/// Along the chute, of the momentum at the start.
struct Momentum {
  double made, on_bed;
};

Momentum run_into_bed(BedInChute b) {
  b.start = 1.6;
  lbm::LiquidRegion sheet{Vec3(0.1, 0, 0), Vec3(1.5, b.width, kDepth)};
  sheet.velocity = b.speed * Vec3::UnitX();
  ChuteLedger ledger(b, sheet);
  ledger.run_until(kDuration);
  return {ledger.made() / ledger.start(), ledger.on_bed() / ledger.start()};
}

std::vector<Row> run(const Context& context) {
  constexpr double bar = 0.02;
  using enum lbm::BodyWeighting;
  constexpr double stopped = 0.5;  // of the momentum, at least: else there would be little to make
  std::vector<Row> rows;
  const auto ask = [&](const char* name, int cells, const BedInChute& b) {
    const std::string what = fmt::format("{}, sheet of {} cells: ", name, cells);
    const Momentum found = run_into_bed(b);
    rows.push_back(absolute_row(what + "momentum made, of that at the start", found.made, 0, bar));
    rows.push_back(at_least_row(what + "the bed got, of that at the start", found.on_bed, stopped));
  };
  const auto resolved = [&](const char* name, int cells, lbm::BodyWeighting weighting) {
    ask(name, cells, {.cell_size = kDepth / cells, .weighting = weighting});
  };
  const auto averaged = [&](int cells) {
    const coupling::AveragedGrains grains{.drag = coupling::BedDrag::gidaspow};
    ask("averaged", cells, {.cell_size = kDepth / cells, .grains = grains});
  };
  if (context.quick) {
    averaged(2);
    return rows;
  }
  resolved("inertial", 4, inertial), resolved("inertial", 8, inertial), resolved("wall_distance", 4, wall_distance);
  averaged(4);
  return rows;
}

}  // namespace

Entry stream_into_bed() { return {"grains_in_fluid.stream_into_bed", {"conservation of momentum", {}}, run}; }

}  // namespace lahar::validate
