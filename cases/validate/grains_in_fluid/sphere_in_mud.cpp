// Drag of a fixed sphere in a slow stream of a yield-stress or shear-thinning fluid, as
//   Cs = F / (3 pi K D^2 (U/D)^n),   Bn = yield (D/U)^n / K,
// against the fields that make the dissipation least (drag_in_mud_reference.py). The mud far from the sphere moves as
// a plug, so a small box will do; a slab at its start holds the plug at the velocity of the stream.
#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <string>

#include "cases/validate/entry.h"
#include "cases/validate/grains_in_fluid/sphere_flow.h"
#include "cases/validate/reference_table.h"

namespace lahar::validate {

namespace {

constexpr double kViscosity = 0.3;        ///< effective, at the shear rate U/D; lu
constexpr double kReynolds = 0.05;        ///< with it
constexpr double kLimitViscosity = 1000;  ///< times kViscosity: below the yield stress
constexpr int kLong = 6, kWide = 5;       ///< the box in diameters
constexpr int kSlab = 4;                  ///< cells
constexpr double kHeld = 1e12;            ///< drag in the slab: that of a rigid body
constexpr double kSettled = 1e-3;         ///< change of the drag while a diameter's vorticity diffuses

struct Mud {
  double exponent, bingham;  ///< n, Bn
  double drag;               ///< Cs of the reference
};

double drag_in(const Mud& mud, int diameter, const Immersion& how) {
  const double d = diameter, speed = kReynolds * kViscosity / d, rate = speed / d;
  const double consistency = kViscosity * std::pow(rate, 1 - mud.exponent) / (1 + mud.bingham);
  Immersion immersion = how;
  immersion.rheology = {mud.exponent == 1 ? lbm::FlowLaw::bingham : lbm::FlowLaw::herschel_bulkley,
                        mud.bingham * consistency * std::pow(rate, mud.exponent), consistency, mud.exponent,
                        kLimitViscosity * kViscosity};
  const Vec3i cells = diameter * Vec3i(kLong, kWide, kWide);
  const Vec3 centre(0.5 * kLong * d + 0.3, 0.5 * kWide * d + 0.21, 0.5 * kWide * d + 0.37);
  const double of_flow = consistency * std::pow(rate, mud.exponent - 1);  // by which scenes are to let bodies weigh
  SphereFlow<double> flow(cells, of_flow, Vec3::Zero(), immersion, {centre}, d / 2, speed * Vec3::UnitX());
  flow.set_fringe({0, kSlab, speed, kHeld});
  const int every = static_cast<int>(d * d / kViscosity);
  double force = 0, former = 0;
  for (int round = 0; round < 40; ++round) {
    for (int k = 0; k < every; ++k) flow.step();
    force = flow.force().x();
    if (std::abs(force - former) < kSettled * std::abs(force)) break;
    former = force;
  }
  return force / (3 * std::numbers::pi * consistency * d * d * std::pow(rate, mud.exponent));
}

std::vector<Row> run(const Context& context) {
  std::vector<Row> rows;
  const ReferenceTable table = reference("drag_in_mud.csv").where("body", "sphere");
  const auto ask = [&](const char* n, const char* bn, int cells, const Immersion& how, const char* by) {
    const ReferenceTable row = table.where("n", n).where("Bn", bn);
    const Mud mud{row.number("n"), row.number("Bn"), row.number("C")};
    rows.push_back(relative_row(fmt::format("Cs, n {}, Bn {}, {} cells, {}", n, bn, cells, by),
                                drag_in(mud, cells, how), mud.drag, 0.12));
  };
  const Immersion by_moments{.collision = lbm::CentralMoments{}};
  for (const auto& [n, bn] : {std::pair{"1", "1"}, {"1", "10"}, {"1", "100"}, {"0.5", "0"}, {"0.5", "1"}}) {
    if (context.quick && std::string(bn) != "10") continue;
    ask(n, bn, 8, {}, "trt");
    ask(n, bn, 8, by_moments, "central moments");
  }
  if (!context.quick) ask("1", "100", 16, by_moments, "central moments");
  return rows;
}

}  // namespace

Entry sphere_in_mud() {
  return {"grains_in_fluid.sphere_in_mud",
          {"least dissipation (Prager 1954), computed; Beris et al. 1985", {"drag_in_mud.csv"}},
          run};
}

}  // namespace lahar::validate
