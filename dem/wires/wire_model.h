#pragma once
// How wires meet what touches them.
#include <cstdint>

namespace lahar::dem {

/// How wires touch grains and each other: bead by bead, or as smooth round wires along the beads (docs/theory.md).
enum class WireContacts : std::uint8_t { beads, capsules };

}  // namespace lahar::dem
