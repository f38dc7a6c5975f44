#pragma once
// One run of the study: which flow, how it is computed, and what of the net is read otherwise.
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace lahar::study {

/// A choice of an axis of the study: its name on the command line and in folders, and the scene values that it stands
/// for.
struct Choice {
  std::string name, meaning;
  std::vector<std::string> changes{};
  std::string coupling{};   ///< how the names of the couplings begin in which it says something; empty: in all
  bool same_flow = false;   ///< of presets and variants: it is other numerics alone and counts in the spread
  std::string preset{};     ///< of a variant: the one in which it says something; empty: in all
  std::string no_preset{};  ///< of a variant: the one that it cannot be in; empty: none
  std::string scenes{};     ///< of a preset: how the names of its scene files begin, before the sweep's
  double width = 1.8;       ///< m, of a preset: of the channel

  [[nodiscard]] bool says_something(const std::string& a_preset, const std::string& a_coupling) const {
    return a_coupling.starts_with(coupling) && (preset.empty() || a_preset == preset) && a_preset != no_preset;
  }
};

/// The scene files as_printed.toml and matched.toml, and what of them is in a strip.
const std::vector<Choice>& sweeps();
/// Cell size, stiffness and width. Cells of the paper's size are wider than grains: averaged couplings alone have them.
const std::vector<Choice>& presets();
/// How fluid and grains act on each other.
const std::vector<Choice>& couplings();
/// Readings of the net and the averages, and other cells and steps, that are looked at for one flow; the first is that
/// of the study.
const std::vector<Choice>& variants();
/// m, the paper's ten.
const std::vector<double>& release_distances();

struct StudyCase {
  std::string sweep, preset, coupling, variant;
  double release = 0;  ///< m
  int seed = 1;
  std::vector<std::string> further{};  ///< changes that hold for all cases of a study (--set)
  bool operator==(const StudyCase&) const = default;

  /// Of its folder: as_printed-L4.10-coarse-resolved-seed1, with the variant behind where it is not the study's.
  [[nodiscard]] std::string name() const;
  [[nodiscard]] std::filesystem::path scene_file() const;
  /// key=value, in the order in which they hold.
  [[nodiscard]] std::vector<std::string> changes() const;
};

/// The case whose name() this is; none where there is no such case.
std::optional<StudyCase> case_named(const std::string& name, const std::vector<std::string>& further);

/// Throws InputError where a change (--set) makes a scene that is refused. Scenes that differ in distance and seed
/// alone are taken to be refused alike.
void check_changes(const std::vector<StudyCase>& study_cases);

/// Whether the case is a part of a flow's width: its masses, energies and forces are not the paper's, nor is its net.
bool is_strip(const StudyCase& c);

/// Whether two cases are of one flow and coupling and differ by numerics and chance alone: not by a net, a law or
/// averages that are read otherwise, nor by their width, nor by cells as wide as the paper's, which stand for its
/// method.
bool count_in_one_spread(const StudyCase& a, const StudyCase& b);

/// The order of tables: by flow, then preset, coupling, variant, seed, each as in its list.
bool comes_before(const StudyCase& a, const StudyCase& b);

/// What the command line asks for; what is empty stands for its default.
struct Selection {
  std::vector<std::string> sweeps{}, presets{}, couplings{}, variants{};
  std::vector<double> releases{};  ///< m
  std::vector<int> seeds{};
  std::vector<std::string> further{};  ///< changes to every scene
};

/// All combinations: by default both sweeps of ten distances, coarse, resolved and averaged, seed 1, the study's
/// reading. Variants that say nothing in a coupling or preset are left out there, as are couplings that a preset cannot
/// have. Throws InputError for a name that is none, with those that there are, for variants that say nothing in any of
/// those asked for, and for presets and couplings that are asked for and have no case.
std::vector<StudyCase> cases_of(const Selection& selection);

/// What the whole study holds. Coarse: both sweeps, resolved and averaged. `standard`: 1.85, 4.10 and 8.60 m resolved,
/// 4.10 m averaged. At 4.10 m, for the spread: second seeds, half the time step, rock of full stiffness, cells of 1.5
/// cm and `fine` ones; and the two other ways to hold the lower cable. `strip`: four seeds from 1.85, 4.10 and 8.60 m.
std::vector<StudyCase> planned_cases();

}  // namespace lahar::study
