// Drag of a thin wire by the drag law, across a slow stream of a Bingham fluid, against the field that makes the
// dissipation least: what the law adds for the yield stress, at the speed that it makes out of the speeds in the cells.
//
// The body force balances the drag of the nominal speed U. Where the drag found differs, the stream has another speed
// U' by the time it is measured, and the reference is that of U': per length F' = C(Bn') K U' with
//   Bn' = yield d / (K U') = Bn U/U'.
#include <fmt/format.h>

#include <cmath>

#include "cases/validate/entry.h"
#include "cases/validate/reference_table.h"
#include "cases/validate/wires_in_fluid/straight_wire.h"

namespace lahar::validate {
namespace {

constexpr double kSpeed = 0.002;          ///< lu
constexpr double kReynolds = 0.05;        ///< with the viscosity K (1 + Bn)
constexpr double kLimitViscosity = 1000;  ///< times that viscosity: below the yield stress
constexpr double kSteps = 3000;           ///< the drag is the same within 1 % at half of them
constexpr int kWidth = 48;                ///< cells
constexpr double kPlasticLimit = 11.94;   ///< C / Bn as Bn -> infinity, 2 pi + 4 sqrt 2 (Randolph & Houlsby 1984)

/// C = F per length / (K U) of a cylinder in a Bingham fluid. What drag_in_mud.csv has above the plastic limit is
/// nearly a power of Bn: a power between two of its rows, that of the nearest two beyond them.
double cylinder_coefficient(double bingham) {
  const auto known = reference("drag_in_mud.csv").where("body", "cylinder").points("Bn", "C");
  std::size_t k = 1;
  while (k + 1 < known.size() && known[k].first < bingham) ++k;
  const auto above = [&](std::size_t row) { return known[row].second - kPlasticLimit * known[row].first; };
  const double power = std::log(above(k) / above(k - 1)) / std::log(known[k].first / known[k - 1].first);
  return kPlasticLimit * bingham + above(k) * std::pow(bingham / known[k].first, power);
}

Row drag_row(double diameter, double bingham, const Context& context, AuditedStreams& streams) {
  const double viscosity = kSpeed * diameter / kReynolds, plastic = viscosity / (1 + bingham);
  WireStream s = stream_across(diameter, kSpeed * diameter / plastic, kWidth, Vec3(0.1, 0.3, 0));
  const auto drag_at = [&](double speed) {
    return s.cells.z() * cylinder_coefficient(bingham * kSpeed / speed) * plastic * speed;
  };
  s.speed = kSpeed;
  s.travel = kSteps * kSpeed;
  s.rheology = {lbm::FlowLaw::bingham, bingham * plastic * kSpeed / diameter, plastic, 1, kLimitViscosity * viscosity};
  s.expected_drag = drag_at(kSpeed);
  const WireLoad load = streams.run(s, context);
  return relative_row(fmt::format("drag, d/dx {:g}, Bn {:g}", diameter, bingham), load.drag, drag_at(load.speed), 0.15);
}

std::vector<Row> run(const Context& context) {
  std::vector<Row> rows;
  AuditedStreams streams;
  for (const double diameter : {0.5, 1.0, 2.0})
    for (const double bingham : {1.0, 10.0, 100.0})
      if (!context.quick || (diameter == 1 && bingham == 10))
        rows.push_back(drag_row(diameter, bingham, context, streams));
  rows.push_back(streams.audit_row(context));
  return rows;
}

}  // namespace

Entry wire_in_mud() {
  return {"wires_in_fluid.wire_in_mud",
          {"least dissipation (Prager 1954), computed; Randolph & Houlsby 1984", {"drag_in_mud.csv"}},
          run};
}

}  // namespace lahar::validate
