#pragma once
// What is written over a picture of a run: title, time, scale bar and legends.
#include "cases/pictures/camera.h"
#include "cases/pictures/picture.h"
#include "cases/pictures/solids_in_view.h"

namespace lahar::cases {

void annotate(Image& image, const PictureScene& scene, const Camera& camera, const PictureStyle& style,
              const SolidsInView& view);

}  // namespace lahar::cases
