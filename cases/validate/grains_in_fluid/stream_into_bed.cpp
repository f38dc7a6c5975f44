// A sheet of water that runs into a bed of spheres held in place: how much momentum it makes or loses (bed_in_chute.h).
#include <fmt/format.h>

#include "cases/validate/entry.h"
#include "cases/validate/grains_in_fluid/bed_in_chute.h"

namespace lahar::validate {

namespace {

constexpr double kDepth = 0.08;     // m
constexpr double kDuration = 0.16;  // s: no drop has left through the top by then

/// Momentum along the chute that was made, of that at the start.
double momentum_made(BedInChute b) {
  b.start = 1.6;
  lbm::LiquidRegion sheet{Vec3(0.1, 0, 0), Vec3(1.5, b.width, kDepth)};
  sheet.velocity = b.speed * Vec3::UnitX();
  ChuteLedger ledger(b, sheet);
  ledger.run_until(kDuration);
  return ledger.made() / ledger.start();
}

std::vector<Row> run(const Context& context) {
  constexpr double bar = 0.02;
  using enum lbm::BodyWeighting;
  const auto row = [&](const char* name, int cells, const BedInChute& b) {
    return absolute_row(fmt::format("{}, sheet of {} cells: momentum made, of that at the start", name, cells),
                        momentum_made(b), 0, bar);
  };
  const auto resolved = [&](const char* name, int cells, lbm::BodyWeighting weighting) {
    return row(name, cells, {.cell_size = kDepth / cells, .weighting = weighting});
  };
  const auto averaged = [&](int cells) {
    const coupling::AveragedGrains grains{.drag = coupling::BedDrag::gidaspow};
    return row("averaged", cells, {.cell_size = kDepth / cells, .grains = grains});
  };
  if (context.quick) return {averaged(2)};
  return {resolved("inertial", 4, inertial), resolved("inertial", 8, inertial),
          resolved("wall_distance", 4, wall_distance), averaged(4)};
}

}  // namespace

Entry stream_into_bed() { return {"grains_in_fluid.stream_into_bed", {"conservation of momentum", {}}, run}; }

}  // namespace lahar::validate
