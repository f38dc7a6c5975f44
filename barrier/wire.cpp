#include "barrier/wire.h"

#include <algorithm>

#include "core/check.h"

namespace lahar::barrier {

dem::BondSort with_wire_radius(dem::BondSort sort, double wire_diameter) {
  if (sort.bond_radius == 0) sort.bond_radius = 0.5 * wire_diameter;
  return sort;
}

Wire add_wire(const WireSpec& spec, dem::Particles& particles, dem::Bonds& bonds) {
  const auto& points = spec.line.points;
  Wire wire{static_cast<dem::ParticleId>(particles.size()),
            static_cast<std::uint32_t>(points.size()),
            bonds.size(),
            spec.line.segments(),
            spec.line.closed,
            spec.body};
  for (std::size_t k = 0; k < points.size(); ++k) {
    const bool fixed = std::ranges::count(spec.fixed_beads, k) > 0;
    particles.add({.position = points[k],
                   .radius = 0.5 * spec.properties.diameter,
                   .density = spec.properties.density,
                   .mass_scale = spec.properties.mass_scale,
                   .inertia_scale = spec.properties.inertia_scale,
                   .material = spec.properties.material,
                   .kind = dem::ParticleKind::bead,
                   .state = fixed ? dem::ParticleState::fixed : dem::ParticleState::free,
                   .body = spec.body,
                   .rail = fixed ? std::nullopt : spec.rail});
  }
  for (std::size_t k = 0; k < wire.bonds; ++k) {
    const bool dissipates = std::ranges::count(spec.dissipator_bonds, k) > 0;
    const auto next = static_cast<dem::ParticleId>((k + 1) % points.size());
    bonds.add({wire.first_bead + static_cast<dem::ParticleId>(k), wire.first_bead + next,
               dissipates ? spec.dissipator_sort : spec.sort},
              particles);
  }
  return wire;
}

Polyline centre_line(const Wire& wire, const dem::Particles& particles) {
  Polyline line;
  line.closed = wire.closed;
  for (std::uint32_t k = 0; k < wire.beads; ++k)
    line.points.push_back(particles.position[particles.index(wire.first_bead + k)]);
  return line;
}

bool is_whole(const Wire& wire, const dem::Bonds& bonds) {
  for (std::size_t b = wire.first_bond; b < wire.first_bond + wire.bonds; ++b)
    if (!bonds.intact[b]) return false;
  return true;
}

}  // namespace lahar::barrier
