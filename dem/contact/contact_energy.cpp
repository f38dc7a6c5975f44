#include "dem/contact/contact_energy.h"

#include "core/parallel.h"
#include "dem/contact/wall_contacts.h"

namespace lahar::dem {

namespace {

/// A contact at rest: the law tells what its spring holds.
double stored_energy(const ContactLawChoice& law, const MaterialPair& pair, double effective_radius, double overlap) {
  if (!(overlap > 0)) return 0;
  ContactState s;
  s.overlap = overlap;
  s.effective_radius = effective_radius;
  s.effective_mass = s.tangential_mass = 1;
  s.effective_modulus = pair.effective_modulus;
  s.effective_shear_modulus = pair.effective_shear_modulus;
  ContactHistory none;
  return std::visit([&](const auto& l) { return l(s, none, 0.0).elastic_normal; }, law);
}

/// Of sphere i on wall w.
double energy_at_wall(ParticleIndex i, std::uint32_t w, const Particles& p, const Materials& materials,
                      const Walls& walls, const ContactLawChoice& law) {
  const Wall& wall = walls.all()[w];
  return stored_energy(law, materials.pair(p.material[i], wall.material), effective_radius_on(wall.shape, p.radius[i]),
                       p.radius[i] - walls.distance(w, p.position[i]));
}

}  // namespace

double normal_energy(ParticleIndex i, ParticleIndex j, double overlap, const Particles& p, const Materials& materials,
                     const ContactLawChoice& law) {
  const double effective_radius = p.radius[i] * p.radius[j] / (p.radius[i] + p.radius[j]);
  return stored_energy(law, materials.pair(p.material[i], p.material[j]), effective_radius, overlap);
}

EnergyNow energy_now(const Particles& p, const Materials& materials, const Walls& walls,
                     const ContactDetection& contacts, const ContactLawChoice& law, double dt) {
  const ContactSlots &pairs = contacts.pairs(), &wall = contacts.wall_contacts();
  if (pairs.offset.empty()) return {};
  const auto add_remembered = [dt](const ContactSlots& slots, std::uint32_t k, double inverse_mass, Vec3& own) {
    const ContactHistory h = slots.history[k];
    own[1] += 0.5 * h.tangential_stiffness * dot(h.tangential_displacement, h.tangential_displacement);
    own[2] += 0.125 * dt * dt * h.damping_force * h.normal_force * inverse_mass;
  };
  const auto inverse_mass = [&p](ParticleIndex i) {  // as it was in the last step
    return p.state[i] == ParticleState::removed ? 1 / p.mass[i] : p.inverse_mass[i];
  };
  const Vec3 sum = ordered_sum<Vec3>(
      pairs.offset.size() - 1,
      [&](std::size_t id) {
        const ParticleIndex i = p.index(id);
        const bool there = p.state[i] != ParticleState::removed;
        Vec3 own = Vec3::Zero();
        for (std::uint32_t k = pairs.offset[i]; k < pairs.offset[i + 1]; ++k) {
          const ParticleIndex j = pairs.partner[k];
          if (pairs.touching[k] == 0) continue;
          add_remembered(pairs, k, inverse_mass(i) + inverse_mass(j), own);
          if (!there || p.state[j] == ParticleState::removed) continue;
          const double overlap = p.radius[i] + p.radius[j] - (p.position[j] - p.position[i]).norm();
          own[0] += normal_energy(i, j, overlap, p, materials, law);
        }
        for (std::uint32_t k = wall.offset[i]; k < wall.offset[i + 1]; ++k) {
          const std::uint32_t w = wall.partner[k];
          if (wall.touching[k] == 0) continue;
          add_remembered(wall, k, inverse_mass(i), own);
          if (!there) continue;
          own[0] += energy_at_wall(i, w, p, materials, walls, law);
        }
        return own;
      },
      1024, Vec3::Zero());
  return {sum[0], sum[1], sum[2]};
}

double normal_energy_of(ParticleIndex i, const Particles& p, const Materials& materials, const Walls& walls,
                        const ContactDetection& contacts, const ContactLawChoice& law) {
  double energy = 0;
  const auto add = [&](ParticleIndex j) {
    if (p.state[j] == ParticleState::removed) return;  // it took the energy of this contact with it
    const double overlap = p.radius[i] + p.radius[j] - (p.position[j] - p.position[i]).norm();
    energy += normal_energy(i, j, overlap, p, materials, law);
  };
  const ContactSlots &pairs = contacts.pairs(), &wall = contacts.wall_contacts();
  if (i + 1 >= pairs.offset.size()) return 0;  // joined after the last step: in no contact yet
  for (std::uint32_t k = pairs.offset[i]; k < pairs.offset[i + 1]; ++k)
    if (pairs.touching[k]) add(pairs.partner[k]);
  const ContactParties& parties = contacts.parties();
  const std::size_t chunk = i / kContactChunk;
  for (std::uint32_t n = parties.first_partner[chunk]; n < parties.first_partner[chunk + 1]; ++n) {
    const std::uint32_t k = parties.as_partner[n].slot;
    if (pairs.partner[k] == i && pairs.touching[k]) add(pairs.owner[k]);
  }
  for (std::uint32_t k = wall.offset[i]; k < wall.offset[i + 1]; ++k) {
    if (!wall.touching[k]) continue;
    energy += energy_at_wall(i, wall.partner[k], p, materials, walls, law);
  }
  return energy;
}

}  // namespace lahar::dem
