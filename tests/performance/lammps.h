#pragma once
// The same particles in LAMMPS (Debian's package `lammps`), for comparison: writes a data file and a script, runs `lmp`
// and reads its loop time. Nothing of LAMMPS is linked; without `lmp` there is no comparison.
#include <optional>
#include <string>

#include "dem/solids.h"
#include "tests/performance/solids_scenes.h"

namespace lahar::performance {

/// Is `lmp` there?
[[nodiscard]] bool have_lammps();

/// Particle-steps per second of LAMMPS over `steps` steps from the present state of `solids`, on `processes` MPI
/// processes. Contacts: pair_style gran/hertz/history with the stiffness of `pair`; bonds become harmonic springs of
/// their axial stiffness between beads that do not touch each other. Half-space walls become fix wall/gran where they
/// are normal to an axis. Nothing if `lmp` fails; its output then is in the error stream.
[[nodiscard]] std::optional<double> lammps_rate(const dem::Solids& solids, const ScenePair& pair, int processes,
                                                int steps);

}  // namespace lahar::performance
