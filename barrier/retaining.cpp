#include "barrier/retaining.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "barrier/construction.h"
#include "core/check.h"
#include "dem/time_step.h"

namespace lahar::barrier {

namespace {

std::string cable_of(int k) { return "the retaining cable of post " + std::to_string(k); }
std::string through_net(int k) { return cable_of(k) + " runs through the net, expected an anchor clear of it"; }

/// Whether two centre-lines come nearer to each other than this, m.
bool meet(const Polyline& a, const Polyline& b, double apart) { return distance(a, b, Vec3::Zero(), apart) < apart; }

/// Whether a cable comes nearer to a wire of the panel than its nodes' surfaces.
bool passes(const Polyline& cable, const MeshPart& mesh, const Construction& c) {
  for (std::size_t b = mesh.first_bond; b < mesh.first_bond + mesh.bonds; ++b) {
    const Polyline wire{{c.particles.position[c.bonds.i[b]], c.particles.position[c.bonds.j[b]]}, false};
    if (meet(cable, wire, c.particles.radius[c.bonds.i[b]] + 0.5 * c.spec.net.wire_diameter)) return true;
  }
  return false;
}

/// Refuses a cable that runs through the net, a post or an element that stands already.
void check_room(int k, const Wire& cable, const Construction& c) {
  const Polyline line = centre_line(cable, c.particles);
  for (const MeshPart& mesh : c.net.meshes)
    if (passes(line, mesh, c)) throw InputError(through_net(k));
  const double d = c.spec.net.wire_diameter;
  for (const Polyline& other : centre_lines(c.net, c.particles))
    if (meet(line, other, d)) throw InputError(through_net(k));
  for (const std::vector<Wire>& elements : c.net.elements)
    for (const Wire& other : elements)
      if (meet(line, centre_line(other, c.particles), d))
        throw InputError(cable_of(k) + " runs into another one, expected an anchor clear of it");
  for (std::size_t p = 0; p < c.net.posts.size(); ++p) {
    const bool own = static_cast<int>(p) == k;
    // Its own post it meets at the head: the bead there counts as touched.
    Polyline axis = centre_line(c.net.posts[p].wire, c.particles);
    if (own) axis.points.pop_back();
    if (meet(line, axis, c.net.posts[p].radius + 0.5 * d))
      throw InputError(cable_of(k) + " runs through post " + std::to_string(p) + ", expected an anchor clear of it");
  }
}

void add_at_post(int k, const RetainingCable& cable, Construction& c, std::vector<Wire>& wires) {
  const RingNetSpec& net = c.spec.net;
  const CableSorts& sorts = c.cable_sorts();
  const Retaining made =
      add_retaining(c.net.posts[static_cast<std::size_t>(k)], post_base(c.spec, k) + cable.anchor, cable.dissipators_at,
                    net.bead_properties(), sorts, c.tie_sort, c.next_body(), c.particles, c.bonds);
  check_room(k, made.wire, c);
  wires.push_back(made.wire);
  c.net.ties.push_back(made.tie);
  for (std::size_t b = made.wire.first_bond; b < made.wire.first_bond + made.wire.bonds; ++b)
    if (c.bonds.sort[b] == sorts.dissipator) c.net.dissipators.push_back(b);
}

}  // namespace

void RetainingCable::add_to(Construction& construction, std::vector<Wire>& wires) const {
  const int last = construction.spec.spans;
  if (post < -1 || post > last)
    throw InputError("a retaining cable is for post " + std::to_string(post) + ", expected 0 to " +
                     std::to_string(last) + ", or -1 for all");
  for (int k = 0; k <= last; ++k)
    if (post == -1 || post == k) add_at_post(k, *this, construction, wires);
}

double RetainingCable::beads(const SpansSpec& spec) const {
  const double d = spec.net.wire_diameter, whole = std::hypot(spec.post_height, anchor.norm());
  const double at_head = (0.5 * spec.post_diameter + 0.55 * d) * whole / anchor.norm();  // see add_retaining
  return (post < 0 ? spec.spans + 1.0 : 1.0) * std::max(1.0, (whole - at_head) / d);
}

double RetainingCable::bond_limit(const SpansSpec& spec) const {
  const double wire = spec.net.bond_limit(spec.net.cable);
  return dissipators_at.empty() ? wire : std::min(wire, spec.net.bond_limit(spec.net.dissipator));
}

Retaining add_retaining(const Post& post, const Vec3& anchor, const std::vector<double>& dissipators_at,
                        const WireProperties& properties, const CableSorts& sorts, int tie_sort, std::int32_t body,
                        dem::Particles& particles, dem::Bonds& bonds) {
  const auto place = [&](dem::ParticleId bead) { return particles.position[particles.index(bead)]; };
  const Vec3 head = place(post.head()), foot = place(post.wire.first_bead);
  const Vec3 axis = (head - foot).normalized(), from = anchor - foot;
  if ((from - from.dot(axis) * axis).norm() < 2 * post.radius)
    throw InputError("the anchor of a retaining cable lies at its post, expected it a post's diameter away at least");
  const Vec3 back = (anchor - head).normalized();
  // Its last bead is clear of the post, along which a steep cable leads.
  const double away = (back - back.dot(axis) * axis).norm();
  const double at_head = (post.radius + 0.55 * properties.diameter) / away;
  if (at_head >= (anchor - head).norm())
    throw InputError(
        "the anchor of a retaining cable lies so near its post that no cable fits, expected it farther away");
  const Vec3 end = head + at_head * back;
  Retaining made;
  made.wire = add_cable(cable_line({.start = anchor, .end = end}, properties.diameter),
                        {.fixed_at = {0}, .fixed_all = false, .dissipators_at = dissipators_at}, properties, sorts,
                        body, particles, bonds);
  made.tie = bonds.size();
  bonds.add({made.wire.first_bead + made.wire.beads - 1, post.head(), tie_sort}, particles);
  return made;
}

}  // namespace lahar::barrier
