#include "cases/assembly/load.h"

#include <fmt/format.h>

#include "cases/assembly/cross_checks.h"
#include "cases/assembly/load_shapes.h"
#include "cases/assembly/rigid_barrier.h"
#include "cases/scene/reader.h"
#include "cases/scene/value.h"

namespace lahar::scene {
namespace {

/// The absolute names of files stand in the resolved scene, which must load again.
void check_file_names(const Scene& scene, Findings& findings) {
  const auto check = [&](const ShapeFile& shape, const std::string& key) {
    if (shape.file.empty() || fits_in_toml(shape.file)) return;
    findings.mistake(
        key, fmt::format("{}: {} is not UTF-8, expected folders whose names are", key, string_text(shape.file)));
  };
  for (std::size_t i = 0; i < scene.walls.size(); ++i) check(scene.walls[i].file, fmt::format("wall[{}].file", i));
  for (std::size_t i = 0; i < scene.fluid.regions.size(); ++i)
    check(scene.fluid.regions[i].file, fmt::format("fluid.region[{}].file", i));
}

/// What is off holds defaults, so that two scenes that run alike compare alike.
void normalise(Scene& scene) {
  scene.identity.base.reset();
  scene.identity.changes.clear();
  if (!scene.fluid.enabled) scene.fluid = {};
  if (!scene.barrier.enabled) scene.barrier = {};
  if (!scene.barrier.posts.enabled) scene.barrier.posts = {};
  if (!scene.coupling.enabled) scene.coupling = {};
  scene.measure.section_x = section_of(scene);
}

}  // namespace

Scene load(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  Findings findings(file.string());
  std::vector<InputMistake> bad_overrides;
  const toml::table root = read_document(file, overrides, bad_overrides);
  for (const InputMistake& m : bad_overrides) findings.mistake_at({m.file, m.line, m.column}, m.message);
  Scene scene;
  Reader reader(root, "", findings);
  describe(reader, scene);
  reader.refuse_unknown();
  const auto note_places = [&findings](const std::string& path, auto& parts) {
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const Place at = findings.place(fmt::format("{}[{}]", path, i));
      parts[i].written_at = {at.file, at.line, at.column};
    }
  };
  note_places("grains.packing", scene.grains.packings);
  note_places("grains.sphere", scene.grains.spheres);
  const Place at = findings.place("barrier");
  scene.barrier.written_at = {at.file, at.line, at.column};
  build_rigid_barrier(scene, findings);
  load_shapes(scene, findings);
  check_file_names(scene, findings);
  check_together(scene, findings);
  findings.raise();
  normalise(scene);
  return scene;
}

}  // namespace lahar::scene
