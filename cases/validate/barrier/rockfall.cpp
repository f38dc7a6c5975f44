// A ball of 825 kg from 16 m on a ring net: when is it stopped (paper: 0.25 s), what takes its energy, do edge rings
// slide along their cables, and does everything hold together? The same net with its edge rings tied says what the
// sliding (curtain effect) is worth. The quick form is a net of 5 x 5 rings and a lighter ball; the paper's figures do
// not belong to it.
#include "cases/rockfall/rockfall.h"

#include "cases/rockfall/report.h"
#include "cases/validate/barrier/result_rows.h"

namespace lahar::validate {

namespace {

cases::Rockfall small_rockfall() {
  cases::Rockfall r;
  r.net_width = 5 * r.ring_pitch;
  r.ball_diameter = 0.45;
  r.ball_mass = 100;
  r.drop_height = 8;
  r.activation_force = 6e3;
  r.settling_time = 0.04;  // no rest, but enough to hang in the guides
  r.duration = 0.12;
  return r;
}

std::vector<Row> run(const Context& context) {
  const auto go_on = [](double) { return true; };
  cases::Rockfall paper = context.quick ? small_rockfall() : cases::Rockfall{};
  const cases::SettledNet net(paper, go_on);
  const cases::RockfallResult slides = net.strike(paper, go_on);
  if (!context.plots.empty()) cases::draw_rockfall(context.plots, slides);
  std::vector<Row> rows = rows_of(cases::rockfall_sanity(slides, paper), "");
  if (context.quick) return rows;
  for (Row& row : rows_of(cases::rockfall_paper_checks(slides), "")) rows.push_back(std::move(row));

  cases::Rockfall fast = paper;
  fast.tied = true;
  const cases::RockfallResult tied = net.strike(fast, go_on);
  for (Row& row : rows_of(cases::rockfall_sanity(tied, fast), "rings tied: ")) rows.push_back(std::move(row));
  rows.push_back(at_least_row("curtain effect: ball stopped later than with rings tied by, s",
                              slides.lowest_time - tied.lowest_time, 0.001));
  rows.push_back(note_row("depth, m, against rings tied", slides.depth, tied.depth));
  rows.push_back(note_row("largest cable tension, kN, against rings tied", 1e-3 * slides.largest_tension,
                          1e-3 * tied.largest_tension));
  rows.push_back(note_row("mean travel of edge rings, m, against rings tied", slides.mean_travel, tied.mean_travel));
  return rows;
}

}  // namespace

Entry rockfall() { return {"barrier.rockfall", {"Li, Zhao & Kwan 2020, section 3.3, Table 3, Fig. 7"}, run}; }

}  // namespace lahar::validate
