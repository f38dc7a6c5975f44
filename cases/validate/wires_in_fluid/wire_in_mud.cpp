// Drag of a thin wire by the drag law, across a slow stream of a Bingham fluid, against the field that makes the
// dissipation least: what the law adds for the yield stress, at the speed that it makes out of the speeds in the cells.
#include <fmt/format.h>

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

Row drag_row(double diameter, const char* bn, const Context& context, AuditedStreams& streams) {
  const double known = reference("drag_in_mud.csv").where("body", "cylinder").where("Bn", bn).number("C");
  const double viscosity = kSpeed * diameter / kReynolds, bingham = std::stod(bn), plastic = viscosity / (1 + bingham);
  WireStream s = stream_across(diameter, kSpeed * diameter / plastic, kWidth, Vec3(0.1, 0.3, 0));
  s.speed = kSpeed;
  s.travel = kSteps * kSpeed;
  s.rheology = {lbm::FlowLaw::bingham, bingham * plastic * kSpeed / diameter, plastic, 1, kLimitViscosity * viscosity};
  s.expected_drag = s.cells.z() * known * plastic * kSpeed;
  return relative_row(fmt::format("drag, d/dx {:g}, Bn {}", diameter, bn), streams.run(s, context).drag,
                      s.expected_drag, 0.15);
}

std::vector<Row> run(const Context& context) {
  std::vector<Row> rows;
  AuditedStreams streams;
  for (const double diameter : {0.5, 1.0, 2.0})
    for (const char* bn : {"1", "10", "100"})
      if (!context.quick || (diameter == 1 && std::string(bn) == "10"))
        rows.push_back(drag_row(diameter, bn, context, streams));
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
