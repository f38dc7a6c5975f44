#include "cases/compare_cfd_dem/study_case.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>
#include <sstream>
#include <tuple>

#include "cases/assembly/load.h"
#include "cases/files/case_file.h"
#include "core/check.h"

namespace lahar::study {

const std::vector<Choice>& sweeps() {
  static const std::vector<Choice> all{
      {"as_printed", "grains rub on bed and sides as Table 4 says"},
      {"matched", "grains slide on bed and sides without friction: the paper's inflow"}};
  return all;
}

const std::vector<Choice>& presets() {
  static const std::vector<std::string> softened{"fluid.cell_size_m=0.02", "fluid.adaptive_time_step=true",
                                                 "materials.rock.youngs_modulus_Pa=3.5e9",
                                                 "barrier.net.bead_mass_scale=3", "solids.two_rates=true"};
  static const std::vector<Choice> all{
      {"coarse",
       "cells of 2 cm, an adaptive step, beads of three times the inertia and the same weight, rock of a twentieth of "
       "the stiffness, whose contacts take longer steps than beads do",
       softened, "", true},
      {"standard", "cells of 1 cm, nothing softened", {}, "", true},
      {"fine", "cells of 5 mm, nothing softened", {"fluid.cell_size_m=0.005"}, "", true},
      {"paper_cells",
       "cells of 15 cm, as in Table 4, wider than the grains: for averaged couplings alone; otherwise as coarse",
       {"fluid.cell_size_m=0.15", "fluid.adaptive_time_step=true", "materials.rock.youngs_modulus_Pa=3.5e9",
        "barrier.net.bead_mass_scale=3", "solids.two_rates=true"},
       "averaged"},
      {.name = "strip",
       .meaning = "as coarse, 0.3 m of the width, along whose sides grains slide without friction, to 3 s: for many "
                  "seeds",
       .changes = softened,
       .same_flow = false,
       .scenes = "strip_",
       .width = 0.3}};
  return all;
}

const std::vector<Choice>& couplings() {
  static const std::vector<Choice> all{
      {"resolved", "the fluid flows round grains and through the openings of the net", {"coupling.grains=resolved"}},
      {"averaged",
       "grains by a drag law over 0.15 m, wires by theirs",
       {"coupling.grains=averaged", "coupling.averaging_length_m=0.15", "coupling.bed_drag=di_felice"}},
      {"averaged_ergun",
       "the same, with Ergun's drag of packed beds in place of Di Felice's",
       {"coupling.grains=averaged", "coupling.averaging_length_m=0.15", "coupling.bed_drag=gidaspow"}},
      {"averaged_beads",
       "as averaged, and the beads of wires by the law of grains, as the paper has it",
       {"coupling.grains=averaged", "coupling.averaging_length_m=0.15", "coupling.bed_drag=di_felice",
        "coupling.beads_as_grains=true"}}};
  return all;
}

const std::vector<Choice>& variants() {
  static const std::vector<Choice> all{
      {"study", "the lower cable held along the bed, the net hanging before the run", {}, "", true},
      {"cable_fixed", "every bead of the lower cable fixed", {"barrier.anchors.bottom_cable=fixed"}},
      {"cable_at_ends", "the lower cable held at its ends alone", {"barrier.anchors.bottom_cable=at_places"}},
      {"as_built", "the net begins as built, free of stress", {"barrier.settle_time_s=0"}},
      {"rigid_grains",
       "covered cells take the grains' velocity at once, which carries too much water along",
       {"coupling.body_weighting=wall_distance"},
       "resolved"},
      {"rockfall_dissipators",
       "dissipators as soft as those of the paper's rockfall (Table 3), which has the same rings and cables",
       {"barrier.bonds.dissipator_stiffness_N_m3=[3.5e8, 3.5e7]"}},
      {"short_averages",
       "averages over 0.08 m, the diameter of the large grains",
       {"coupling.averaging_length_m=0.08"},
       "averaged",
       false,
       "",
       "paper_cells"},
      {"half_speed", "half the time step of the fluid", {"fluid.lattice_velocity=0.05"}, "", true},
      {"cells_15mm", "cells of 1.5 cm", {"fluid.cell_size_m=0.015"}, "", true, "coarse"},
      {"cells_10mm", "cells of 1 cm, as standard, the rest as coarse", {"fluid.cell_size_m=0.01"}, "", true, "coarse"},
      {"stiff_rock", "rock as stiff as Table 4 says", {"materials.rock.youngs_modulus_Pa=70e9"}, "", true, "coarse"},
      {"light_beads", "beads without added inertia", {"barrier.net.bead_mass_scale=1"}, "", true, "coarse"},
      {"soft_bonds", "bonds of a fifth of the stiffness", {"solids.bond_stiffness_scale=0.2"}}};
  return all;
}

const std::vector<double>& release_distances() {
  static const std::vector<double> all{1.85, 2.60, 3.35, 4.10, 4.85, 5.60, 6.35, 7.10, 7.85, 8.60};
  return all;
}

namespace {

const Choice& find(const std::vector<Choice>& all, const std::string& name) {
  return *std::find_if(all.begin(), all.end(), [&](const Choice& c) { return c.name == name; });
}

}  // namespace

std::string StudyCase::name() const {
  const std::string own = fmt::format("{}-L{:.2f}-{}-{}-seed{}", sweep, release, preset, coupling, seed);
  return variant == variants().front().name ? own : own + "-" + variant;
}

std::filesystem::path StudyCase::scene_file() const {
  return cases::case_file("compare_cfd_dem/" + find(presets(), preset).scenes + sweep + ".toml");
}

bool is_strip(const StudyCase& c) { return find(presets(), c.preset).width < presets().front().width; }

bool count_in_one_spread(const StudyCase& a, const StudyCase& b) {
  const auto numerics_alone = [](const std::vector<Choice>& all, const std::string& one, const std::string& other) {
    return find(all, one).same_flow && find(all, other).same_flow;
  };
  return a.sweep == b.sweep && a.release == b.release && a.coupling == b.coupling &&
         (a.preset == b.preset || numerics_alone(presets(), a.preset, b.preset)) &&
         numerics_alone(variants(), a.variant, b.variant);
}

std::vector<std::string> StudyCase::changes() const {
  constexpr double channel_below_net = 1.5;  // m
  const double width = find(presets(), preset).width;
  std::string scene_name = name();  // names of scenes hold no points
  std::replace(scene_name.begin(), scene_name.end(), '.', '_');
  std::vector<std::string> all{
      fmt::format("scene.name=\"{}\"", scene_name),
      fmt::format("scene.title=\"{}, L = {:.2f} m, {}, {}\"", sweep, release, preset, coupling),
      fmt::format("run.seed={}", seed),
      fmt::format("domain.upper_m=[{:.2f}, {:g}, 1.5]", release + channel_below_net, width),
      fmt::format("barrier.net.origin_m=[{:.2f}, 0.0, 0.0]", release),
      fmt::format("section[net].point_m=[{:.2f}, {:g}, 0.48]", release, 0.5 * width)};
  for (const Choice* choice : {&find(presets(), preset), &find(couplings(), coupling), &find(variants(), variant)})
    all.insert(all.end(), choice->changes.begin(), choice->changes.end());
  all.insert(all.end(), further.begin(), further.end());
  return all;
}

std::optional<StudyCase> case_named(const std::string& name, const std::vector<std::string>& further) {
  std::vector<std::string> parts;
  std::istringstream text(name);
  for (std::string part; std::getline(text, part, '-');) parts.push_back(part);
  if (parts.size() == 5) parts.push_back(variants().front().name);
  if (parts.size() != 6) return std::nullopt;
  StudyCase c{parts[0], parts[2], parts[3], parts[5], 0, 0, further};
  const auto is_in = [](const std::vector<Choice>& all, const std::string& one) {
    return std::any_of(all.begin(), all.end(), [&](const Choice& choice) { return choice.name == one; });
  };
  if (!is_in(sweeps(), c.sweep) || !is_in(presets(), c.preset) || !is_in(couplings(), c.coupling) ||
      !is_in(variants(), c.variant) || std::sscanf(parts[1].c_str(), "L%lf", &c.release) != 1 ||
      std::sscanf(parts[4].c_str(), "seed%d", &c.seed) != 1 ||
      !find(presets(), c.preset).says_something(c.preset, c.coupling))
    return std::nullopt;
  return c.name() == name ? std::optional(c) : std::nullopt;
}

void check_changes(const std::vector<StudyCase>& study_cases) {
  std::set<std::string> checked;
  for (StudyCase c : study_cases) {
    if (c.further.empty()) continue;  // the study's own scenes
    c.release = study_cases.front().release, c.seed = study_cases.front().seed;
    if (checked.insert(c.name()).second) (void)scene::load(c.scene_file(), c.changes());
  }
}

bool comes_before(const StudyCase& a, const StudyCase& b) {
  const auto place = [](const StudyCase& c) {
    const auto at = [](const std::vector<Choice>& all, const std::string& one) {
      return std::find_if(all.begin(), all.end(), [&](const Choice& choice) { return choice.name == one; }) -
             all.begin();
    };
    return std::tuple(at(sweeps(), c.sweep), c.release, at(presets(), c.preset), at(couplings(), c.coupling),
                      at(variants(), c.variant), c.seed);
  };
  return place(a) < place(b);
}

namespace {

/// Those that were asked for, or the default.
std::vector<std::string> chosen(const char* option, const std::vector<Choice>& all,
                                const std::vector<std::string>& asked, const std::vector<std::string>& otherwise) {
  for (const std::string& name : asked)
    if (std::none_of(all.begin(), all.end(), [&](const Choice& c) { return c.name == name; })) {
      std::vector<std::string> names;
      for (const Choice& c : all) names.push_back(c.name);
      throw InputError(std::vector<InputMistake>{
          {"command line", 1, 1, fmt::format("{} {}: expected one of {}", option, name, fmt::join(names, ", "))}});
    }
  return asked.empty() ? otherwise : asked;
}

std::vector<double> chosen_releases(const std::vector<double>& asked) {
  for (const double release : asked)
    if (!(release >= 1.2 && release <= 20) || std::abs(100 * release - std::round(100 * release)) > 1e-6)
      throw InputError(std::vector<InputMistake>{
          {"command line", 1, 1,
           fmt::format("--release {:g}: expected 1.2 to 20 m, in whole centimetres, from the upstream end of the "
                       "mixture, 0.75 m long, to the net",
                       release)}});
  return asked.empty() ? release_distances() : asked;
}

/// Each preset and each coupling that is asked for by name has to have the other.
void check_presets(const std::vector<std::string>& preset_names, const std::vector<std::string>& asked_couplings) {
  const auto can_be = [](const std::string& preset, const std::string& coupling) {
    return find(presets(), preset).says_something(preset, coupling);
  };
  const auto has_coupling = [&](const std::string& p) {
    return std::any_of(asked_couplings.begin(), asked_couplings.end(), [&](const auto& c) { return can_be(p, c); });
  };
  const auto has_preset = [&](const std::string& c) {
    return std::any_of(preset_names.begin(), preset_names.end(), [&](const auto& p) { return can_be(p, c); });
  };
  for (const auto& preset : preset_names)
    for (const auto& coupling : asked_couplings) {
      if (can_be(preset, coupling) || (has_coupling(preset) && has_preset(coupling))) continue;
      throw InputError(std::vector<InputMistake>{
          {"command line", 1, 1,
           fmt::format("--preset {} with --coupling {}: its cells are wider than the grains, which cannot be resolved "
                       "by them, expected a coupling that begins with {}",
                       preset, coupling, find(presets(), preset).coupling)}});
    }
}

}  // namespace

std::vector<StudyCase> cases_of(const Selection& s) {
  const auto sweep_names = chosen("--sweep", sweeps(), s.sweeps, {"as_printed", "matched"});
  const auto preset_names = chosen("--preset", presets(), s.presets, {"coarse"});
  const auto coupling_names = chosen("--coupling", couplings(), s.couplings, {"resolved", "averaged"});
  const auto variant_names = chosen("--variant", variants(), s.variants, {"study"});
  check_presets(preset_names, s.couplings);
  const std::vector<double> releases = chosen_releases(s.releases);
  const std::vector<int> seeds = s.seeds.empty() ? std::vector<int>{1} : s.seeds;
  for (const int seed : seeds)
    if (seed < 0)
      throw InputError(std::vector<InputMistake>{
          {"command line", 1, 1, fmt::format("--seed {}: expected at least 0, as run.seed of a scene", seed)}});
  std::vector<StudyCase> all;
  const auto add = [&](const StudyCase& c) {  // what is asked for twice is run once
    if (std::none_of(all.begin(), all.end(), [&](const StudyCase& other) { return other.name() == c.name(); }))
      all.push_back(c);
  };
  for (const auto& preset : preset_names)
    for (const auto& variant : variant_names)
      for (const int seed : seeds)
        for (const auto& sweep : sweep_names)
          for (const double release : releases)
            for (const auto& coupling : coupling_names)
              if (find(presets(), preset).says_something(preset, coupling) &&
                  find(variants(), variant).says_something(preset, coupling))
                add({sweep, preset, coupling, variant, release, seed, s.further});
  for (const auto& variant : variant_names)
    if (std::none_of(all.begin(), all.end(), [&](const StudyCase& c) { return c.variant == variant; })) {
      const Choice& choice = find(variants(), variant);
      const auto none_is = [](const std::vector<std::string>& names, const auto& fits) {
        return std::none_of(names.begin(), names.end(), fits);
      };
      std::string with;
      if (none_is(coupling_names, [&](const auto& name) { return name.starts_with(choice.coupling); }))
        with += fmt::format(" --coupling {}, expected one that begins with {}", fmt::join(coupling_names, ", "),
                            choice.coupling);
      if (!choice.preset.empty() && none_is(preset_names, [&](const auto& name) { return name == choice.preset; }))
        with += fmt::format(" --preset {}, expected {}", fmt::join(preset_names, ", "), choice.preset);
      if (with.empty()) with = fmt::format(" --preset {}, expected another", fmt::join(preset_names, ", "));
      throw InputError(std::vector<InputMistake>{
          {"command line", 1, 1, fmt::format("--variant {}: says nothing with{}", variant, with)}});
    }
  return all;
}

std::vector<StudyCase> planned_cases() {
  std::vector<StudyCase> all;
  for (const Selection& part :
       {Selection{}, Selection{.presets = {"standard"}, .couplings = {"resolved"}, .releases = {1.85, 4.10, 8.60}},
        Selection{.presets = {"standard"}, .couplings = {"averaged"}, .releases = {4.10}},
        Selection{.variants = {"cells_15mm", "half_speed", "stiff_rock"}, .releases = {4.10}},
        Selection{.releases = {4.10}, .seeds = {2}},
        Selection{.presets = {"fine"}, .couplings = {"resolved"}, .releases = {4.10}},
        Selection{.sweeps = {"as_printed"},
        .couplings = {"resolved"},
        .variants = {"cable_fixed", "cable_at_ends"},
        .releases = {4.10}},
        Selection{.presets = {"strip"}, .releases = {1.85, 4.10, 8.60}, .seeds = {1, 2, 3, 4}}})
    for (StudyCase& c : cases_of(part)) all.push_back(std::move(c));
  return all;
}

}  // namespace lahar::study
