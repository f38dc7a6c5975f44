#include "barrier/post.h"

#include <cmath>
#include <numbers>

#include "barrier/link.h"
#include "core/check.h"

namespace lahar::barrier {

namespace {

constexpr double steel_shear_share = 1 / 2.6;  // G / E at a Poisson's ratio of 0.3

void check(const PostSpec& s) {
  const PostSection& p = s.section;
  if (!(p.youngs_modulus > 0 && p.area > 0 && p.second_moment > 0 && p.density > 0))
    throw InputError("a post needs a modulus, an area, a second moment and a density above 0");
  const double length = (s.head - s.foot).norm();
  if (!(s.diameter > 0 && length >= 5 * s.diameter))
    throw InputError("a post of " + std::to_string(length) + " m between its end beads and " +
                     std::to_string(s.diameter) + " m diameter is no beam: it must be five diameters long at least");
  require(std::abs(s.across.norm() - 1) < 1e-9 && std::abs(s.across.dot(s.head - s.foot)) < 1e-9 * length,
          "a post's direction across must be a unit vector at right angles to it");
}

/// Three links that hold the foot and let it turn.
void add_joint(const PostSpec& s, double stiffness, Post& post, dem::Particles& particles, dem::Bonds& bonds) {
  const int sort = bonds.add_sort(link_bond(stiffness, 0.5 * s.diameter));
  const Vec3 along = (s.head - s.foot).normalized();
  post.foot_beads.clear();
  for (const Vec3& direction : {s.across, Vec3(along.cross(s.across)), Vec3(-along)}) {
    post.foot_beads.push_back(particles.add({.position = s.foot + 0.25 * s.diameter * direction,
                                             .radius = 0.1 * s.diameter,
                                             .density = s.section.density,
                                             .material = s.material,
                                             .kind = dem::ParticleKind::bead,
                                             .state = dem::ParticleState::fixed,
                                             .body = s.body}));
    post.joint.push_back(bonds.size());
    bonds.add({post.foot_beads.back(), post.wire.first_bead, sort}, particles);
  }
}

}  // namespace

double post_spacing(double length, double diameter) {
  return length / std::max(1.0, std::floor(length / diameter * (1 + 1e-9)));
}

double post_bead_mass(const PostSection& section, double spacing) { return section.density * section.area * spacing; }

dem::BondSort post_bond(const PostSection& section, double spacing) {
  dem::BondSort sort;
  sort.bond_radius = 2 * std::sqrt(section.second_moment / section.area);
  const double round = std::numbers::pi * sort.bond_radius * sort.bond_radius;
  const double per_area = section.youngs_modulus * section.area / (spacing * round);
  sort.axial.stiffness = {per_area, per_area, per_area};
  sort.shear_stiffness = steel_shear_share * per_area;
  sort.damping_ratio = section.damping_ratio;
  return sort;
}

Post add_post(const PostSpec& spec, dem::Particles& particles, dem::Bonds& bonds) {
  check(spec);
  const Vec3 axis = spec.head - spec.foot;
  const double spacing = post_spacing(axis.norm(), spec.diameter);
  const auto pieces = static_cast<int>(std::lround(axis.norm() / spacing));
  WireSpec wire;
  for (int k = 0; k <= pieces; ++k) wire.line.points.push_back(spec.foot + axis * (double(k) / pieces));
  wire.properties.diameter = spec.diameter;
  wire.properties.density = post_bead_mass(spec.section, spacing) / (std::numbers::pi / 6 * std::pow(spec.diameter, 3));
  wire.properties.material = spec.material;
  wire.sort = bonds.add_sort(post_bond(spec.section, spacing));
  wire.body = spec.body;
  if (spec.foot_joint == FootJoint::fixed) wire.fixed_beads = {0};
  Post post{add_wire(wire, particles, bonds), 0.5 * spec.diameter};
  post.foot_beads = {post.wire.first_bead};
  particles.bury(post.wire.first_bead);
  if (spec.foot_joint == FootJoint::hinged)
    add_joint(spec, spec.section.youngs_modulus * spec.section.area / spacing, post, particles, bonds);
  return post;
}

Vec3 foot_reaction(const Post& post, const dem::Particles& particles) {
  Vec3 sum = Vec3::Zero();
  for (const dem::ParticleId bead : post.foot_beads) sum -= particles.force[particles.index(bead)];
  return sum;
}

Vec3 foot_moment(const Post& post, const dem::Particles& particles) {
  const Vec3 foot = particles.position[particles.index(post.wire.first_bead)];
  Vec3 sum = Vec3::Zero();
  for (const dem::ParticleId bead : post.foot_beads) {
    const dem::ParticleIndex i = particles.index(bead);
    sum -= Vec3(particles.position[i] - foot).cross(Vec3(particles.force[i])) + Vec3(particles.torque[i]);
  }
  return sum;
}

}  // namespace lahar::barrier
