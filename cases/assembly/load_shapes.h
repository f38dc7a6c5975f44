#pragma once
// Walls and liquid from files: read, placed, and sampled as signed distances.
#include "cases/scene/findings.h"
#include "cases/scene/scene.h"

namespace lahar::scene {

/// Loads all files of walls and regions whose description is sound, and sets `sampled`, the absolute name of the file,
/// and the bounds of regions. File names are relative to the scene (or base scene) that they stand in; those given on
/// the command line to the working folder. What is wrong with a file is a mistake of its key, told where the command
/// line or scene.changes set another key that has a part in it.
void load_shapes(Scene& scene, Findings& findings);

}  // namespace lahar::scene
