#include "dem/wires/wire_contact.h"

#include <cmath>

#include "core/check.h"

namespace lahar::dem {

namespace {

void add(WireSide& side, ParticleIndex particle, double weight, const Triple& gradient) {
  std::size_t k = 0;
  while (k < side.count && side.shares[k].particle != particle) ++k;
  if (k == side.count) {
    require(side.count < side.shares.size(), "a patch of smooth wires over more beads than it has room for");
    side.shares[side.count++] = {particle, 0, Triple{}};
  }
  side.shares[k].weight += weight;
  side.shares[k].gradient = side.shares[k].gradient + gradient;
}

struct Motion {
  Triple velocity{}, spin{}, velocity_end{}, spin_end{};
  double inverse_mass = 0, tangential_inverse_mass = 0;  // 1/kg
};

Motion motion_of(const WireSide& side, const Triple& normal, const Particles& p, double dt) {
  Motion m;
  for (std::size_t k = 0; k < side.count; ++k) {
    const ParticleIndex i = side.shares[k].particle;
    const double weight = side.shares[k].weight;
    const double inverse = p.inverse_mass[i];
    const Triple v = triple_at(p.velocity, i), w = triple_at(p.angular_velocity, i);
    const Triple v_end = v + (0.5 * dt * inverse) * triple_at(p.force, i);
    const Triple w_end = w + (0.5 * dt * p.inverse_inertia(i)) * triple_at(p.torque, i);
    m.velocity = m.velocity + weight * v, m.velocity_end = m.velocity_end + weight * v_end;
    m.spin = m.spin + weight * w, m.spin_end = m.spin_end + weight * w_end;
    m.inverse_mass += weight * weight * p.free_share(i, normal) * inverse;
    m.tangential_inverse_mass += weight * weight * inverse;
  }
  return m;
}

}  // namespace

double effective_radius_of_wires(double r, double other) { return std::sqrt(r * other); }

double effective_radius_on_sphere(double r, double sphere) { return sphere / std::sqrt(1 + sphere / r); }

void describe(const WirePatch& patch, const SplineSegment& segment, const WirePartner& partner,
              const WireSphere& sphere, double reach, double radius, WireContact& c) {
  c.wire.count = c.partner.count = 0;
  c.overlap = equivalent_overlap(patch.integral, reach);
  const double per_node = 0.8 * c.overlap / patch.integral;  // de = 2/5 e/I dI, dI = 2 sum of overlap d(overlap) dl
  double sum = 0;
  Triple resultant{}, wire{}, other{};
  for (std::size_t m = 0; m < patch.count; ++m) {
    const PatchNode& n = patch.nodes[m];
    sum += n.weight * n.overlap;
  }
  for (std::size_t m = 0; m < patch.count; ++m) {
    const PatchNode& n = patch.nodes[m];
    const double share = n.weight * n.overlap / sum;
    const Triple pull = per_node * n.weight * n.overlap * n.normal;
    // Less what lies along the wire, but for a sphere in front of its end.
    const double along = dot(n.normal, n.along);
    resultant = resultant + per_node * n.weight * n.overlap * (n.normal - along * (1 - along * along) * n.along);
    wire = wire + share * n.point, other = other + share * n.nearest.point;
    const auto weights = segment.weights(n.s), slopes = segment.weight_slopes(n.s);
    // Beads that move apart lengthen the patch: dI = sum of overlap^2 d(dl).
    const Triple stretch = (0.5 * per_node * n.overlap * n.overlap * n.share) * n.along;
    for (std::size_t b = 0; b < 3; ++b)
      if (weights[b] > 0) add(c.wire, segment.beads[b], share * weights[b], weights[b] * pull + slopes[b] * stretch);
    if (sphere.there) {
      add(c.partner, sphere.particle, share, -1.0 * pull);
      continue;
    }
    const SplineSegment& other_segment = partner.segments[n.nearest.segment];
    const auto other_weights = other_segment.weights(n.nearest.t);
    for (std::size_t b = 0; b < 3; ++b)
      if (other_weights[b] > 0)
        add(c.partner, other_segment.beads[b], share * other_weights[b], -other_weights[b] * pull);
  }
  c.spread = length(resultant);
  c.normal = (1 / c.spread) * resultant;
  const Triple between = other - wire;
  const double distance = length(between);
  const double part = (radius - 0.5 * (reach - distance)) / distance;  // the middle of the overlap
  c.wire.lever = part * between;
  c.partner.lever = (part - 1) * between;
}

void set_motion(const WireContact& c, const Particles& particles, double dt, ContactState& s) {
  const Motion a = motion_of(c.wire, c.normal, particles, dt), b = motion_of(c.partner, c.normal, particles, dt);
  s.overlap = c.overlap;
  s.normal_ij = c.normal;
  const Triple slip = a.velocity - b.velocity + cross(a.spin, c.wire.lever) - cross(b.spin, c.partner.lever);
  const Triple slip_end =
      a.velocity_end - b.velocity_end + cross(a.spin_end, c.wire.lever) - cross(b.spin_end, c.partner.lever);
  s.closing_speed = c.spread * dot(slip_end, c.normal);
  const auto together = [](double inverse) { return inverse > 0 ? 1 / inverse : 0.0; };
  s.effective_mass = together(c.spread * c.spread * (a.inverse_mass + b.inverse_mass));
  s.tangential_mass = together(a.tangential_inverse_mass + b.tangential_inverse_mass);  // whose force has no lever
  s.tangential_velocity = normal_part(slip, c.normal);
  s.tangential_velocity_end = normal_part(slip_end, c.normal);
  s.twist_rate = 0.5 * dot(a.spin + b.spin, c.normal);
}

}  // namespace lahar::dem
