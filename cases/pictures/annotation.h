#pragma once
// What is written over a picture of a run: title, time, scale bar and legends.
#include <string>

#include "cases/pictures/camera.h"
#include "cases/pictures/picture.h"
#include "cases/pictures/solids_in_view.h"

namespace lahar::cases {

/// "1.250 s"; three significant digits below 0.01 s, "2.5e-09 s".
std::string time_label(double seconds);

void annotate(Image& image, const PictureScene& scene, const Camera& camera, const PictureStyle& style,
              const SolidsInView& view);

}  // namespace lahar::cases
