// Cross checks of what is measured: probes and sections.
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "cases/assembly/cross_checks.h"
#include "cases/assembly/measured_names.h"
#include "cases/scene/names.h"
#include "cases/scene/value.h"

namespace lahar::scene {
namespace {

/// A force is measured on exactly one wall.
void check_wall_of(const Scene& scene, const Probe& probe, const std::string& path, Findings& findings) {
  if (!findings.sound({path, "wall"})) return;
  const auto named = [&](const WallSettings& w) { return w.name == probe.wall; };
  if (!probe.wall.empty() && std::any_of(scene.walls.begin(), scene.walls.end(), named)) return;
  std::vector<std::string> known;
  for (const WallSettings& w : scene.walls) known.push_back(w.name);
  const std::string nearest = nearest_name(probe.wall, known);
  const std::string hint = nearest.empty() ? "" : fmt::format(" (did you mean {}?)", string_text(nearest));
  findings.mistake(path,
                   fmt::format("{} is {}{}, expected the name of a [[wall]]", path, string_text(probe.wall), hint));
}

void check_probe(const Scene& scene, std::size_t i, Findings& findings) {
  const Probe& probe = scene.probes[i];
  const std::string path = fmt::format("probe[{}]", i);
  if (!findings.sound({path, "domain", "fluid"})) return;
  if (probe.kind == ProbeKind::force) return check_wall_of(scene, probe, path + ".wall", findings);
  const bool of_grain = probe.kind == ProbeKind::grain;
  if (!of_grain && !scene.fluid.enabled)
    findings.mistake(path, path + " without a fluid, expected fluid.enabled = true");
  if (of_grain && scene.grains.packings.empty() && scene.grains.spheres.empty())
    findings.mistake(path, path + " without grains, expected a table of [grains]");
  if (!scene.domain.contains(probe.position))
    findings.mistake(path + ".position_m", path + ".position_m lies outside the domain, expected it inside [domain]");
  const double most = (scene.domain.upper - scene.domain.lower).maxCoeff();
  if (probe.diameter > most)
    findings.mistake(path + ".diameter_m", fmt::format("{}.diameter_m is {:g}, expected at most the largest extent of "
                                                       "the domain, {:g}",
                                                       path, probe.diameter, most));
}

void check_flux_section(const Scene& scene, std::size_t i, Findings& findings) {
  const FluxSection& s = scene.sections[i];
  const std::string path = fmt::format("section[{}]", i);
  if (!findings.sound({path})) return;
  if (s.normal.norm() == 0) findings.mistake(path + ".normal", path + ".normal is zero, expected a direction");
  if (findings.sound({"domain"}) && !scene.domain.contains(s.point))
    findings.mistake(path + ".point_m", path + ".point_m lies outside the domain, expected it inside [domain]");
}

/// Nothing that a probe or a section measures is called as something else is.
void check_measured_names(const Scene& scene, Findings& findings) {
  std::map<std::string, std::string> owners;
  for (const std::string& name : own_names()) owners.emplace(name, "the program");
  const auto claim = [&](const auto& measurement, const std::string& path) {
    if (!findings.sound({path})) return;
    std::string clash;
    for (const std::string& name : names_of(measurement)) {
      const auto [known, is_new] = owners.emplace(name, path);
      if (!is_new && clash.empty() && known->second != path) clash = name + "\", a name of " + known->second;
    }
    if (!clash.empty())
      findings.mistake(path + ".name", fmt::format("{}.name is \"{}\" and would write \"{}, expected another name",
                                                   path, measurement.name, clash));
  };
  for (std::size_t i = 0; i < scene.probes.size(); ++i) claim(scene.probes[i], fmt::format("probe[{}]", i));
  for (std::size_t i = 0; i < scene.sections.size(); ++i) claim(scene.sections[i], fmt::format("section[{}]", i));
}

}  // namespace

void check_probes(const Scene& scene, Findings& findings) {
  for (std::size_t i = 0; i < scene.probes.size(); ++i) check_probe(scene, i, findings);
  for (std::size_t i = 0; i < scene.sections.size(); ++i) check_flux_section(scene, i, findings);
  check_measured_names(scene, findings);
}

}  // namespace lahar::scene
