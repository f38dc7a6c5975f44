#pragma once
// Keys of energy_dissipator's parameters: see cases/scene/schema.h.
#include "cases/energy_dissipator/energy_dissipator.h"
#include "cases/scene/names.h"
#include "cases/scene/schema.h"

namespace lahar::cases {

constexpr auto choices(BrakeUnloading) {
  return std::to_array<scene::Choice<BrakeUnloading>>(
      {{"elastic", BrakeUnloading::elastic}, {"plastic", BrakeUnloading::plastic}});
}

/// The three tables of the file, each with its own part of the parameters.
struct BrakePart {
  EnergyDissipator& brake;
};
struct CablePart {
  EnergyDissipator& brake;
};
struct StretchPart {
  EnergyDissipator& brake;
};

template <class V>
void describe(V& v, BrakePart& part) {
  EnergyDissipator& s = part.brake;
  v.value("stiffness_N_m3", s.stiffness, {.range = scene::positive(), .min_count = 2, .max_count = 3},
          "Axial stiffness of the two or three stages per unit area.");
  v.value("force_limit_N", s.force_limit, {.range = scene::positive(), .min_count = 1, .max_count = 2},
          "Force at which each stage but the last ends.");
  v.value("last_force_N", s.last_force, {scene::positive()}, "Force up to which it is stretched.");
  v.value("unloading", s.unloading, {}, "Back along the curve, or with the first stiffness.");
  v.value("bond_radius_m", s.bond_radius, {scene::positive()}, "Radius of all bonds.");
  v.value("damping_ratio", s.damping_ratio, {scene::between(0, 1)}, "Damping of all bonds, as a share of critical.");
}

template <class V>
void describe(V& v, CablePart& part) {
  EnergyDissipator& s = part.brake;
  v.value("beads", s.cable_beads, {scene::between(1, 1000)}, "Beads of cable on either side of the dissipator.");
  v.value("bead_diameter_m", s.bead_diameter, {scene::positive()}, "Diameter of all beads.");
  v.value("density_kg_m3", s.density, {scene::positive()}, "Density of all beads.");
}

template <class V>
void describe(V& v, StretchPart& part) {
  EnergyDissipator& s = part.brake;
  v.value("speed_m_s", s.speed, {scene::positive()}, "Speed of the pulled end.");
  v.value("samples", s.samples, {scene::between(100, 100000)}, "Points of the curve while it is stretched.");
  v.value("safety", s.safety, {scene::above_up_to(0, 1)}, "Share of the critical time step that is used.");
}

/// energy_dissipator.toml
template <class V>
void describe(V& v, EnergyDissipator& s) {
  BrakePart brake{s};
  CablePart cable{s};
  StretchPart loading{s};
  v.table("dissipator", brake, scene::Presence::optional, "The dissipator.");
  v.table("cable", cable, scene::Presence::optional, "The cable that it is in; its bonds have the first stiffness.");
  v.table("loading", loading, scene::Presence::optional, "The pull.");
}

}  // namespace lahar::cases
