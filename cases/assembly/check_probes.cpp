// Cross checks of what is measured: probes and sections.
#include <fmt/format.h>

#include <algorithm>

#include "cases/assembly/cross_checks.h"
#include "cases/scene/names.h"

namespace lahar::scene {
namespace {

/// A force is measured on exactly one wall.
void check_wall_of(const Scene& scene, const Probe& probe, const std::string& path, Findings& findings) {
  if (!findings.sound({path, "wall"})) return;
  const auto named = [&](const WallSettings& w) { return w.name == probe.wall; };
  const auto count = std::count_if(scene.walls.begin(), scene.walls.end(), named);
  if (count == 1 && !probe.wall.empty()) return;
  if (count > 1)
    return findings.mistake(
        path, fmt::format("{} is \"{}\", the name of {} walls, expected that of one", path, probe.wall, count));
  std::vector<std::string> known;
  for (const WallSettings& w : scene.walls) known.push_back(w.name);
  const std::string nearest = nearest_name(probe.wall, known);
  const std::string hint = nearest.empty() ? "" : fmt::format(" (did you mean \"{}\"?)", nearest);
  findings.mistake(path, fmt::format("{} is \"{}\"{}, expected the name of a [[wall]]", path, probe.wall, hint));
}

void check_probe(const Scene& scene, std::size_t i, Findings& findings) {
  const Probe& probe = scene.probes[i];
  const std::string path = fmt::format("probe[{}]", i);
  if (!findings.sound({path, "domain", "fluid"})) return;
  if (probe.kind == ProbeKind::force) return check_wall_of(scene, probe, path + ".wall", findings);
  if (!scene.fluid.enabled) findings.mistake(path, path + " without a fluid, expected fluid.enabled = true");
  if (!scene.domain.contains(probe.position))
    findings.mistake(path + ".position_m", path + ".position_m lies outside the domain, expected it inside [domain]");
}

void check_flux_section(const Scene& scene, std::size_t i, Findings& findings) {
  const FluxSection& s = scene.sections[i];
  const std::string path = fmt::format("section[{}]", i);
  if (!findings.sound({path})) return;
  if (s.normal.norm() == 0) findings.mistake(path + ".normal", path + ".normal is zero, expected a direction");
  if (findings.sound({"domain"}) && !scene.domain.contains(s.point))
    findings.mistake(path + ".point_m", path + ".point_m lies outside the domain, expected it inside [domain]");
}

}  // namespace

void check_probes(const Scene& scene, Findings& findings) {
  for (std::size_t i = 0; i < scene.probes.size(); ++i) check_probe(scene, i, findings);
  for (std::size_t i = 0; i < scene.sections.size(); ++i) check_flux_section(scene, i, findings);
}

}  // namespace lahar::scene
