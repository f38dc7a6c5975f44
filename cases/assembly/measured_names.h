#pragma once
// Names in series.h5 and summary.json: those of the program, and those that probes and sections bring along.
#include <string>
#include <vector>

#include "cases/scene/scene.h"

namespace lahar::scene {

/// Names of quantities that runs have without probes and sections, whatever is in the scene.
std::vector<std::string> own_names();
/// Names of what a probe or a section measures.
std::vector<std::string> names_of(const Probe& probe);
std::vector<std::string> names_of(const FluxSection& section);

}  // namespace lahar::scene
