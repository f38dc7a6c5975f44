#pragma once
// Keys of rockfall's parameters: see cases/scene/schema.h.
#include "cases/rockfall/rockfall.h"
#include "cases/scene/schema.h"

namespace lahar::cases {

/// The tables of the file, each with its own part of the parameters.
struct RockfallNet {
  Rockfall& all;
};
struct RockfallBonds {
  Rockfall& all;
};
struct RockfallContact {
  Rockfall& all;
};
struct RockfallBall {
  Rockfall& all;
};
struct RockfallRun {
  Rockfall& all;
};

template <class V>
void describe(V& v, RockfallNet& part) {
  using scene::positive;
  Rockfall& s = part.all;
  v.value("width_m", s.net_width, {positive()}, "Side of the square net.");
  v.value("ring_diameter_m", s.ring_diameter, {positive()}, "Diameter of a ring along the wire's centre-line.");
  v.value("ring_pitch_m", s.ring_pitch, {positive()}, "Distance between the centres of linked rings.");
  v.value("beads_per_ring", s.beads_per_ring, {scene::between(8, 1000)}, "Beads that make up a ring; they touch.");
  v.value("wire_diameter_m", s.wire_diameter, {positive()}, "Diameter of wire and beads, cables too.");
  v.value("density_kg_m3", s.density, {positive()}, "Density of the beads.");
  v.value("cable_extension_m", s.cable_extension, {positive()},
          "Length of each cable beyond a corner: more than a dissipator draws out.");
  v.value("dissipators_per_cable", s.dissipators_per_cable, {scene::between(1, 2)}, "At one end, or at both.");
  v.value("guide_stiffness_N_m", s.guide_stiffness, {positive()}, "Of the guides at the corners, sideways.");
  v.value("tied", s.tied, {}, "Edge rings are bonded to their cables and cannot slide.");
}

template <class V>
void describe(V& v, RockfallBonds& part) {
  using scene::positive;
  Rockfall& s = part.all;
  v.value("ring_stiffness_N_m3", s.ring_stiffness, {positive()}, "Normal and shear, per unit area.");
  v.value("cable_stiffness_N_m3", s.cable_stiffness, {positive()}, "The same of cable bonds.");
  v.value("dissipator_stiffness_N_m3", s.dissipator_stiffness, {.range = positive(), .min_count = 2, .max_count = 2},
          "Of the two stages of a dissipator.");
  v.value("activation_force_N", s.activation_force, {positive()}, "At which the first stage ends.");
  v.value("plastic_unloading", s.plastic_unloading, {}, "Dissipators unload with the first stiffness.");
  v.value("damping_ratio", s.bond_damping_ratio, {scene::between(0, 1)}, "As a share of critical.");
}

template <class V>
void describe(V& v, RockfallContact& part) {
  Rockfall& s = part.all;
  v.value("youngs_modulus_Pa", s.youngs_modulus, {scene::positive()}, "Of rings and cables.");
  v.value("poisson_ratio", s.poisson_ratio, {scene::between(0, 0.5)}, "Of rings and cables.");
  v.value("friction", s.friction, {scene::non_negative()}, "Between all.");
  v.value("restitution", s.restitution, {scene::above_up_to(0, 1)}, "Between all.");
  v.value("capsules", s.capsules, {}, "Wires touch as smooth round wires instead of bead by bead.");
}

template <class V>
void describe(V& v, RockfallBall& part) {
  using scene::positive;
  Rockfall& s = part.all;
  v.value("diameter_m", s.ball_diameter, {positive()}, "Diameter.");
  v.value("mass_kg", s.ball_mass, {positive()}, "Mass.");
  v.value("youngs_modulus_Pa", s.ball_modulus, {positive()}, "Of its contacts.");
  v.value("poisson_ratio", s.ball_poisson_ratio, {scene::between(0, 0.5)}, "Of its contacts.");
  v.value("drop_height_m", s.drop_height, {positive()}, "Above the net's plane, from which its speed comes.");
}

template <class V>
void describe(V& v, RockfallRun& part) {
  using scene::non_negative, scene::positive;
  Rockfall& s = part.all;
  v.value("settling_time_s", s.settling_time, {non_negative()}, "For which the net sags before the ball comes.");
  v.value("settling_drag_1_s", s.settling_drag, {non_negative()},
          "Drag in the last third of that time, deceleration per velocity.");
  v.value("duration_s", s.duration, {positive()}, "From the moment when the ball's bottom is in the net's plane.");
  v.value("time_step_s", s.time_step, {non_negative()}, "0 = 0.7 of the smallest limit of a bond.");
  v.value("sample_interval_s", s.sample_interval, {positive()},
          "Time between entries of the series, at least a time step.");
}

/// rockfall.toml
template <class V>
void describe(V& v, Rockfall& s) {
  RockfallNet net{s};
  RockfallBonds bonds{s};
  RockfallContact contact{s};
  RockfallBall ball{s};
  RockfallRun run{s};
  v.table("net", net, scene::Presence::optional, "The ring net in its cables.");
  v.table("bonds", bonds, scene::Presence::optional, "Stiffness of rings, cables and dissipators.");
  v.table("contact", contact, scene::Presence::optional, "Properties of contacts.");
  v.table("ball", ball, scene::Presence::optional, "What falls.");
  v.table("run", run, scene::Presence::optional, "How long.");
}

}  // namespace lahar::cases
