// A column of water of width a and height 2 a collapses over a dry bed: Martin & Moyce 1952, a = 2.25 in, n^2 = 2.
//
// The bed slips: the displacement thickness of its boundary layer grows to 1.7 sqrt(nu t) = 0.7 mm, half a cell of 1.4
// mm, at the end, which no wall rule without a wall model can follow. The rows with a no-slip bed say what that costs.
// The column was held by a waxed paper that was melted; the zero of T is uncertain by its release (the measured front
// has moved 0.22 a at T = 0.84, a free column 0.35 a). The row after a shift in T is no bar of the ladder's table.
#include "cases/validate/entry.h"
#include "cases/validate/free_surface/dam_break.h"
#include "cases/validate/free_surface/surface_charts.h"
#include "cases/validate/free_surface/surface_flows.h"

namespace lahar::validate {

namespace {

std::vector<Row> run(const Context& context) {
  return in_precision(context, [&]<class Real>() {
    DamBreak dam;
    dam.width = context.quick ? 16 : 40;
    const double bar = context.quick ? 0.12 : 0.04;  // the bars are those of the full grid
    const DamBreakRun slip = run_dam_break<Real>(dam);
    dam.slip = false;
    const DamBreakRun stick = run_dam_break<Real>(dam);
    draw_front(context, "martin_moyce", slip.time, slip.front, measured_column().front);
    const FrontErrors e = compare_front(slip), s = compare_front(stick);
    return std::vector<Row>{at_most_row("RMS of the error of Z, of Z", e.rms, bar),
                            at_most_row("the same after the best shift in T", e.shifted_rms, bar),
                            relative_row("slope dZ/dT from T = 1.43 on", e.slope, kFrontSlope, bar),
                            at_most_row("RMS of the error of the column's height, of H", e.height_rms, bar),
                            at_most_row("no-slip bed: RMS of the error of Z, of Z", s.rms, bar),
                            relative_row("no-slip bed: slope dZ/dT", s.slope, kFrontSlope, bar)};
  });
}

}  // namespace

Entry martin_moyce() {
  return {"free_surface.martin_moyce", {"Martin & Moyce 1952, n^2 = 2", {"martin_moyce1952.csv"}}, run};
}

}  // namespace lahar::validate
