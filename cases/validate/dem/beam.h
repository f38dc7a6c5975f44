#pragma once
// A cantilever of bonded beads.
#include "cases/validate/dem/solid_scenes.h"

namespace lahar::validate {

struct BeamSpec {
  const char* name = "";
  int bonds = 20;
  double bead_radius = 0;                            ///< m; beads touch, the bond is as thick as the bead
  double density = 7800;                             ///< kg/m^3
  double normal_stiffness = 0, shear_stiffness = 0;  ///< N/m^3
  double time_step = 0;                              ///< s
};

/// Along x from the origin, first bead held; without gravity.
inline dem::Solids cantilever_of(const BeamSpec& s) {
  dem::Particles p;
  dem::Bonds bonds;
  dem::BondSort sort;
  sort.axial.stiffness = {s.normal_stiffness, s.normal_stiffness, s.normal_stiffness};
  sort.shear_stiffness = s.shear_stiffness;
  sort.bond_radius = s.bead_radius;
  bonds.add_sort(sort);
  for (int k = 0; k <= s.bonds; ++k) {
    dem::ParticleSpec bead;
    bead.position = Vec3(2 * s.bead_radius * k, 0, 0);
    bead.radius = s.bead_radius;
    bead.density = s.density;
    bead.kind = dem::ParticleKind::bead;
    bead.body = 0;
    bead.state = k == 0 ? dem::ParticleState::fixed : dem::ParticleState::free;
    const dem::ParticleIndex i = p.add(bead);
    if (k > 0) bonds.add({i - 1, i, 0}, p);
  }
  return {p, bonds, one_material(1e10, 0.3, 0.1, 1), {}, solids_options(s.time_step, Vec3::Zero())};
}

}  // namespace lahar::validate
