#include "cases/assembly/rigid_barrier.h"

#include <fmt/format.h>

#include "cases/scene/value.h"

namespace lahar::scene {

void build_rigid_barrier(Scene& scene, Findings& findings) {
  const RigidBarrier rigid = scene.rigid_barrier;
  scene.rigid_barrier = {};
  if (!rigid.enabled || !findings.sound({"rigid_barrier"})) return;
  const double slits = static_cast<double>(rigid.slits), pier = (rigid.width - slits * rigid.slit_width) / (slits + 1);
  if (rigid.slits > 0 && rigid.slit_width == 0)
    return findings.mistake("rigid_barrier.slit_width_m",
                            "rigid_barrier.slit_width_m is 0, expected the width of the slits");
  if (rigid.slits == 0 && rigid.slit_width > 0)
    return findings.mistake("rigid_barrier.slit_width_m",
                            "rigid_barrier.slit_width_m without slits, expected rigid_barrier.slits above 0");
  if (pier <= 0)
    return findings.mistake("rigid_barrier.slits",
                            fmt::format("rigid_barrier.slits: {} slits of {:g} m leave nothing of a width of {:g} m, "
                                        "expected fewer or narrower ones",
                                        rigid.slits, rigid.slit_width, rigid.width));
  const bool needed = scene.has_solids() || !rigid.material.empty();
  if (needed && findings.sound({"materials"}) && material_index(scene, rigid.material) < 0)
    return findings.mistake("rigid_barrier.material",
                            fmt::format("rigid_barrier.material is {}, expected the name of a table "
                                        "[materials.NAME]",
                                        string_text(rigid.material)));
  for (std::int64_t k = 0; k <= rigid.slits; ++k) {
    WallSettings wall;
    wall.name = fmt::format("rigid_barrier_{}", k);
    wall.shape = WallShape::box;
    wall.lower = rigid.origin + Vec3(0, static_cast<double>(k) * (pier + rigid.slit_width), 0);
    wall.upper = wall.lower + Vec3(rigid.thickness, pier, rigid.height);
    wall.slip = rigid.slip;
    wall.material = rigid.material;
    scene.walls.push_back(std::move(wall));
  }
  if (scene.fluid.enabled && !scene.barrier.enabled && !scene.measure.section_x)
    scene.measure.section_x = rigid.origin.x();
}

}  // namespace lahar::scene
