#include "cases/hard_cases/hard_cases.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "cases/runner/machine.h"
#include "cases/validate/reference_table.h"

namespace lahar::validate {

namespace {

struct Published {
  const char* id;
  std::vector<std::string> entries;
};

const std::vector<Published>& published() {
  static const std::vector<Published> cases{
      {"H1", {"free_surface.dam_break_low_viscosity"}},
      {"H2", {"free_surface.dam_break_resolution"}},
      {"H3", {"free_surface.hydrostatic_low_viscosity"}},
      {"H4", {"free_surface.thin_films", "free_surface.nusselt_film"}},
      {"H5", {"grains_in_fluid.slamming_sphere"}},
      {"H6", {"free_surface.orifice_jet", "wires_in_fluid.jet_through_ring"}},
      {"H7", {"grains_in_fluid.sphere_across_blocks"}},
      {"H8", {"free_surface.trapped_gas", "grains_in_fluid.gas_under_sphere", "grains_in_fluid.water_entry_cavity"}},
      {"H9", {"dem.bond_breakage", "wires_in_fluid.ring_that_snaps"}},
      {"H10", {"wires_in_fluid.crossing_wires"}},
      {"H11", {"grains_in_fluid.wet_column_collapse"}},
      {"H12", {"grains_in_fluid.restart"}},
      {"H13", {"free_surface.draining_and_rewetting"}},
      {"H14", {"free_surface.impact_in_corner"}},
      {"H15", {"barrier.jammed_boulder"}},
      {"H16", {"barrier.net_in_free_fall"}},
      {"H17", {"grains_in_fluid.bouncing_sphere"}},
      {"H18", {"free_surface.sparse_box"}},
      {"H19", {"fluid.smagorinsky_constants", "free_surface.dam_break_smagorinsky"}},
      {"H20", {"free_surface.slope_in_staircase"}},
  };
  return cases;
}

const std::vector<HardCase>& found_here() {
  static const std::vector<HardCase> cases{
      {"L1",
       "Light spheres in water and in viscous liquid: covered cells that opened and emptied pumped liquid to one side",
       "they float as deep as their density says, and heave at the right period",
       {"grains_in_fluid.floating_sphere"}},
      {"L2",
       "Under-resolved shear layer at vanishing viscosity: most collision operators blow up",
       "the default operator gains no energy, with an eddy viscosity none does",
       {"fluid.shear_layer"}},
      {"L3",
       "A first time step that is wrong by a factor, in a flow that turns fast",
       "the adaptive step finds its way, and the flow is that of a right guess",
       {"free_surface.adaptive_time_step"}},
      {"L4",
       "Water at rest in a tank at an angle to the lattice (with next to nothing that damps it: H3)",
       "speeds stay below their bar, and no liquid is lost",
       {"free_surface.hydrostatic_tilted"}},
      {"L5",
       "Gravel of 2 to 8 cells in water: a closure for packed beds was wrong by factors and by the time step",
       "drag of a bed within a fifth, whatever the time step",
       {"grains_in_fluid.bed_permeability"}},
      {"L6",
       "Rings that fall, touch and part: work of contacts and bonds",
       "energy ledger closed",
       {"dem.energy_ledger"}},
      {"L7",
       "Layers of one to six cells at rest, and sheets that slide: sound between bed and surface fed itself",
       "in each step the bed bears the weight within 1 % (at rest) and 0.1 % (sliding)",
       {"free_surface.thin_layers"}},
  };
  return cases;
}

}  // namespace

std::vector<HardCase> hard_cases() {
  const ReferenceTable table = reference("hard_cases.csv");
  std::vector<HardCase> all;
  for (const Published& p : published()) {
    const ReferenceTable row = table.where("id", p.id);
    all.push_back({p.id, row.text("case"), row.text("pass"), p.entries});
  }
  all.insert(all.end(), found_here().begin(), found_here().end());
  return all;
}

std::vector<HardCase> select_hard_cases(const std::vector<std::string>& ids) {
  const std::vector<HardCase> all = hard_cases();
  const auto has_id = [](const std::string& id) { return [&id](const HardCase& c) { return c.id == id; }; };
  for (const std::string& id : ids)
    if (std::none_of(all.begin(), all.end(), has_id(id)))
      throw std::invalid_argument(fmt::format("no hard case is called '{}', expected {} to {} or {} to {}", id,
                                              published().front().id, published().back().id, found_here().front().id,
                                              found_here().back().id));
  std::vector<HardCase> chosen;
  for (const HardCase& c : all)
    if (ids.empty() || std::find(ids.begin(), ids.end(), c.id) != ids.end()) chosen.push_back(c);
  return chosen;
}

bool HardCaseResult::pass() const {
  return !outcomes.empty() && std::all_of(outcomes.begin(), outcomes.end(), [](const Outcome& o) { return o.pass(); });
}

double HardCaseResult::seconds() const {
  double sum = 0;
  for (const Outcome& o : outcomes) sum += o.seconds;
  return sum;
}

HardCaseResult run_hard_case(const HardCase& hard_case, const Context& context) {
  HardCaseResult result{hard_case, {}};
  for (const Entry& entry : select_entries(all_entries(), hard_case.entries))
    result.outcomes.push_back(run_entry(entry, context));
  return result;
}

std::string result_text(const HardCaseResult& result) {
  std::size_t rows = 0, reached = 0;
  std::string misses;
  for (const Outcome& o : result.outcomes) {
    rows += o.asked(), reached += o.reached();
    for (const Row& r : o.rows)
      if (!r.pass)
        misses += fmt::format("         {}: {}: {:.4g}, error {:.3g}, bar {:.3g}\n", o.name, r.label, r.value, r.error,
                              r.tolerance);
    if (!o.failure.empty()) misses += fmt::format("         {} stopped: {}\n", o.name, o.failure);
  }
  return fmt::format("{:<4} {}  {:>3} of {:<3} {:>8.1f} s  {}\n{}", result.hard_case.id,
                     result.pass() ? "pass " : "SHORT", reached, rows, result.seconds(), result.hard_case.question,
                     misses);
}

namespace {

std::string csv_of(const Row& r) {
  const char* const pass = r.note ? "-" : r.pass ? "true" : "false";
  return fmt::format("{},{:.6g},{},{},{},{}", csv_field(r.label), r.value, figure_text(r, r.reference, 6),
                     figure_text(r, r.error, 6), figure_text(r, r.tolerance, 6), pass);
}

}  // namespace

std::string results_csv(const std::vector<HardCaseResult>& results, const Context& context, const std::string& date) {
  std::string text = fmt::format("# {}, commit {}, {}, {} form, {}\n{}\n", cases::machine_name(), cases::commit(), date,
                                 context.quick ? "quick" : "full", name_of(context.precision), kHardCasesColumns);
  for (const HardCaseResult& result : results)
    for (const Outcome& o : result.outcomes) {
      const HardCase& c = result.hard_case;
      const std::string start = fmt::format("{},{},{},{}", c.id, csv_field(c.question), csv_field(c.criterion), o.name);
      for (const Row& r : o.rows) text += fmt::format("{},{},{:.2f}\n", start, csv_of(r), o.seconds);
      if (!o.failure.empty()) text += fmt::format("{},{},,,,,false,{:.2f}\n", start, csv_field(o.failure), o.seconds);
    }
  return text;
}

}  // namespace lahar::validate
