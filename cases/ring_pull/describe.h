#pragma once
// Keys of ring_pull's parameters: see cases/scene/schema.h.
#include "cases/ring_pull/ring_pull.h"
#include "cases/scene/schema.h"

namespace lahar::cases {

/// The two tables of the file, each with its own part of the parameters.
struct RingPart {
  RingPull& ring;
};
struct LoadingPart {
  RingPull& ring;
};

template <class V>
void describe(V& v, RingPart& part) {
  using scene::between, scene::positive;
  RingPull& s = part.ring;
  v.value("perimeter_m", s.perimeter, {positive()}, "Length of the wire's centre-line.");
  v.value("beads", s.beads, {between(8, 2000)}, "Even number of beads that make up the ring; they touch.");
  v.value("reference_beads", s.reference_beads, {between(8, 2000)},
          "Number of beads that the values below are given for; another number scales them (docs/validation.md).");
  v.value("density_kg_m3", s.density, {positive()}, "Density of the beads.");
  v.value("youngs_modulus_Pa", s.youngs_modulus, {positive()}, "Of contacts between beads.");
  v.value("poisson_ratio", s.poisson_ratio, {between(0, 0.5)}, "Of contacts between beads.");
  v.value("bond_radius_m", s.bond_radius, {positive()}, "Radius of the bonds.");
  v.value("normal_stiffness_N_m3", s.normal_stiffness, {positive()}, "Normal stiffness of the bonds per unit area.");
  v.value("shear_stiffness_N_m3", s.shear_stiffness, {positive()}, "Shear stiffness of the bonds per unit area.");
  v.value("damping_ratio", s.damping_ratio, {between(0, 1)}, "Damping of the bonds, as a share of critical.");
}

template <class V>
void describe(V& v, LoadingPart& part) {
  using scene::above_up_to, scene::between, scene::positive;
  RingPull& s = part.ring;
  v.value("stroke_m", s.stroke, {positive()}, "How far the bead is pulled.");
  v.value("speed_m_s", s.speed, {positive()}, "How fast.");
  v.value("samples", s.samples, {between(20, 100000)}, "Points of the curve.");
  v.value("safety", s.safety, {above_up_to(0, 1)}, "Share of the critical time step that is used.");
}

/// ring_pull.toml
template <class V>
void describe(V& v, RingPull& s) {
  RingPart ring{s};
  LoadingPart loading{s};
  v.table("ring", ring, scene::Presence::optional, "The ring and its bonds.");
  v.table("loading", loading, scene::Presence::optional, "The pull.");
}

}  // namespace lahar::cases
