#include "cases/assembly/cross_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <set>
#include <utility>

#include "cases/scene/names.h"
#include "cases/scene/one_line.h"
#include "cases/scene/value.h"
#include "dem/contact/contact_materials.h"

namespace lahar::scene {
namespace {

bool plain(const std::string& name) {
  return !name.empty() && std::all_of(name.begin(), name.end(), [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '-';
  });
}

void check_plain(const std::string& name, const std::string& path, Findings& findings) {
  if (findings.sound({path}) && !plain(name))
    findings.mistake(path, fmt::format("{} is {}, expected letters, digits, \"_\" and \"-\"", path, string_text(name)));
}

/// Whether a name is a material; "" is allowed where `optional`.
void check_reference(const Scene& scene, const std::string& name, const std::string& path, bool optional,
                     Findings& findings) {
  if (!findings.sound({path}) || (optional && name.empty()) || material_index(scene, name) >= 0) return;
  std::vector<std::string> known;
  for (const MaterialSettings& m : scene.materials) known.push_back(m.name);
  const std::string nearest = nearest_name(name, known);
  const std::string hint = nearest.empty() ? "" : fmt::format(" (did you mean {}?)", string_text(nearest));
  findings.mistake(
      path, fmt::format("{} is {}{}, expected the name of a table [materials.NAME]", path, string_text(name), hint));
}

void check_pairs(const Scene& scene, Findings& findings) {
  std::set<std::pair<std::string, std::string>> seen;
  for (std::size_t i = 0; i < scene.contacts.size(); ++i) {
    const std::string path = fmt::format("contact[{}].materials", i);
    if (!findings.sound({path})) continue;
    for (const std::string& name : scene.contacts[i].materials) check_reference(scene, name, path, false, findings);
    const auto [low, high] = std::minmax(scene.contacts[i].materials[0], scene.contacts[i].materials[1]);
    if (!seen.insert({low, high}).second)
      findings.mistake(path, fmt::format("{} names {} and {} again, expected each pair once", path, string_text(low),
                                         string_text(high)));
  }
}

}  // namespace

void check_names(const Scene& scene, Findings& findings) {
  check_plain(scene.identity.name, "scene.name", findings);
  if (findings.sound({"scene.title"}) && on_one_line(scene.identity.title) != scene.identity.title)
    findings.mistake("scene.title", "scene.title holds a control character, expected one line of text");
  for (std::size_t i = 0; i < scene.fluid.inflows.size(); ++i)
    check_plain(scene.fluid.inflows[i].name, fmt::format("fluid.inflow[{}].name", i), findings);
  std::set<std::string> seen;
  const auto check_own = [&](const std::string& name, const std::string& path) {
    check_plain(name, path, findings);
    if (findings.sound({path}) && !seen.insert(name).second)
      findings.mistake(path, fmt::format("{} is {} again, expected a name of its own", path, string_text(name)));
  };
  for (std::size_t i = 0; i < scene.probes.size(); ++i)
    check_own(scene.probes[i].name, fmt::format("probe[{}].name", i));
  for (std::size_t i = 0; i < scene.sections.size(); ++i)
    check_own(scene.sections[i].name, fmt::format("section[{}].name", i));
  std::set<std::string> walls;  // theirs are no names of files
  for (std::size_t i = 0; i < scene.walls.size(); ++i)
    if (const std::string& name = scene.walls[i].name; !name.empty() && !walls.insert(name).second)
      findings.mistake(fmt::format("wall[{}].name", i),
                       fmt::format("wall[{}].name is {} again, expected a name of its own", i, string_text(name)));
}

void check_materials(const Scene& scene, Findings& findings) {
  // With a mistake in the table of materials, names may be missing for that reason alone.
  if (!findings.sound({"materials"}) && scene.materials.empty()) return;
  if (scene.materials.size() > dem::ContactMaterials::kMost) {
    findings.mistake("materials", fmt::format("materials has {} tables, expected at most {}", scene.materials.size(),
                                              dem::ContactMaterials::kMost));
    return;
  }
  for (std::size_t i = 0; i < scene.walls.size(); ++i)
    check_reference(scene, scene.walls[i].material, fmt::format("wall[{}].material", i), !scene.has_solids(), findings);
  for (std::size_t i = 0; i < scene.grains.packings.size(); ++i) {
    const auto check_each = [&](const auto& tables, const char* key) {
      for (std::size_t k = 0; k < tables.size(); ++k)
        check_reference(scene, tables[k].material, fmt::format("grains.packing[{}].{}[{}].material", i, key, k), false,
                        findings);
    };
    check_each(scene.grains.packings[i].sizes, "sizes");
    check_each(scene.grains.packings[i].log_normal, "log_normal");
    check_each(scene.grains.packings[i].sieved, "sieve_curve");
  }
  for (std::size_t i = 0; i < scene.grains.spheres.size(); ++i)
    check_reference(scene, scene.grains.spheres[i].material, fmt::format("grains.sphere[{}].material", i), false,
                    findings);
  if (scene.barrier.enabled)
    check_reference(scene, scene.barrier.net.material, "barrier.net.material", false, findings);
  check_pairs(scene, findings);
}

void check_together(const Scene& scene, Findings& findings) {
  check_names(scene, findings);
  check_materials(scene, findings);
  check_shapes(scene, findings);
  check_fluid(scene, findings);
  check_grains(scene, findings);
  check_barrier(scene, findings);
  check_uses(scene, findings);
  check_probes(scene, findings);
  check_net_can_be_built(scene, findings);
}

}  // namespace lahar::scene
