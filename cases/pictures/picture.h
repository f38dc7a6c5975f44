#pragma once
// Pictures of a run without any other program: grains and wires as shaded solids, water as a translucent body, the bed
// and walls with a grid, in the true frame where gravity points down.
#include <string>

#include "cases/files/image.h"
#include "cases/pictures/camera.h"
#include "cases/pictures/ray.h"
#include "core/geometry.h"
#include "dem/bonds/bonds.h"
#include "dem/particles.h"
#include "lbm/step/fluid_snapshot.h"

namespace lahar::cases {

/// What there is to see. Anything may be absent.
struct PictureScene {
  const dem::Particles* particles = nullptr;
  const dem::Bonds* bonds = nullptr;
  const lbm::FluidSnapshot* fluid = nullptr;
  const Walls* walls = nullptr;
  ViewBox box;                       ///< what the picture shows; walls are cut to it
  Vec3 gravity = Vec3(0, 0, -9.81);  ///< m/s^2; its direction is down
  double time_s = 0;
};

enum class GrainColour { size, speed };

struct PictureStyle {
  int width = 1280, height = 720;  ///< pixels
  int samples = 2;                 ///< rays per pixel along each edge of the pixel, >= 1
  GrainColour grain_colour = GrainColour::size;
  double full_speed = 0;                              ///< m/s at the end of the colour ramp; 0: the fastest grain
  double full_tension = 0;                            ///< N at the end of the colour ramp; 0: the tautest bond
  double wire_scale = 1;                              ///< factor on the thickness of wires, to make thin ones visible
  double water_clarity = 0.35;                        ///< m of water that let a third of green light through
  Colour water_colour = Colour(0.05F, 0.20F, 0.32F);  ///< linear, of light scattered by deep water
  int water_smoothing = 1;                            ///< passes, see WaterField
  bool time_stamp = true, legend = true;
  std::string title{};  ///< upper left corner
};

/// Computes a picture. Independent of the number of threads. Throws std::logic_error for a degenerate camera or size.
[[nodiscard]] Image render_picture(const PictureScene& scene, const Camera& camera, const PictureStyle& style);

}  // namespace lahar::cases
