#pragma once
// What is written over a picture: title, time and legends.
#include "cases/pictures/picture.h"
#include "cases/pictures/solids_in_view.h"

namespace lahar::cases {

void draw_overlay(Image& image, const PictureScene& scene, const PictureStyle& style, const SolidsInView& view);

}  // namespace lahar::cases
