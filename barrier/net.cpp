#include "barrier/net.h"

#include <algorithm>
#include <cmath>

#include "barrier/clearance.h"
#include "barrier/mesh_net.h"
#include "core/check.h"
#include "core/number_text.h"
#include "dem/time_step.h"

namespace lahar::barrier {

namespace {

constexpr std::array<Side, 4> cable_order{Side::lower, Side::upper, Side::left, Side::right};

const NetCable& cable_spec(const RingNetSpec& spec, Side side) {
  switch (side) {
    case Side::lower:
      return spec.lower;
    case Side::upper:
      return spec.upper;
    case Side::left:
      return spec.left;
    case Side::right:
      break;
  }
  return spec.right;
}

/// Collects what is wrong with a spec.
class Mistakes {
 public:
  void unless(bool condition, const std::string& message) {
    if (!condition) all_.push_back({"barrier", 0, 0, message});
  }
  void raise() const {
    if (!all_.empty()) throw InputError(all_);
  }

 private:
  std::vector<InputMistake> all_;
};

bool orthonormal(const Vec3& a, const Vec3& b, const Vec3& c) {
  Mat3 m;
  m << a, b, c;
  return (m.transpose() * m - Mat3::Identity()).norm() < 1e-6;
}

void check(const RingNetSpec& s) {
  Mistakes wrong;
  wrong.unless(orthonormal(s.across, s.up, s.normal), "across, up and normal must be unit vectors at right angles");
  wrong.unless(s.wire_diameter > 0 && s.density > 0, "wire diameter and density must be positive");
  wrong.unless(s.ring_diameter > 3 * s.wire_diameter,
               "a ring of " + number_text(s.ring_diameter) +
                   " m is too narrow for its wire, expected more than three wires, " +
                   number_text(3 * s.wire_diameter) + " m");
  wrong.unless(s.ring_pitch > 0 && s.width >= s.ring_pitch && s.height >= s.ring_pitch,
               "width and height must hold at least one ring pitch");
  wrong.unless(s.ring_pitch <= 0 || s.ring_pitch > s.wire_diameter,  // each ring is its neighbour moved by the pitch
               "rings at a pitch of " + number_text(s.ring_pitch) +
                   " m lie in each other, expected more than the wire, " + number_text(s.wire_diameter) + " m");
  wrong.unless(s.cable_extension >= 0, "the extension of the cables must not be negative");
  wrong.unless(s.beads_per_ring >= 8, "a ring needs at least 8 beads");
  wrong.raise();
  const double spacing = bead_spacing({s.ring_diameter, s.beads_per_ring}) / s.wire_diameter;
  wrong.unless(spacing <= largest_spacing, "beads of a ring are " + number_text(spacing) +
                                               " diameters apart: beyond sqrt(2) rings pass through each other; take "
                                               "more beads or thicker wire");
  wrong.unless(spacing > 0.75, "beads of a ring overlap: " + number_text(spacing) +
                                   " diameters apart; take fewer beads or thinner wire");
  wrong.raise();
}

/// Length of the frame that `count` rings fill at this pitch.
double filled(const RingNetSpec& spec, int count, double pitch) {
  if (spec.fit == NetFit::cables_on_frame) return count * pitch;
  // Edge rings go around their cables and so reach about 0.3 wire diameters further out than round ones.
  return (count - 1) * pitch + spec.ring_diameter + 1.6 * spec.wire_diameter;
}

struct Filling {
  int count;
  double pitch;  ///< m
};

/// The nearest whole number of rings that fill `length`. Throws InputError if that takes a pitch more than 8 % away
/// from the wanted one.
Filling fill(const RingNetSpec& spec, double length, const std::string& what) {
  const double first = filled(spec, 1, spec.ring_pitch);
  const int count = std::max(1, 1 + static_cast<int>(std::lround((length - first) / spec.ring_pitch)));
  const double spare = length - filled(spec, count, spec.ring_pitch);
  const int steps = spec.fit == NetFit::cables_on_frame ? count : count - 1;
  const double change = spare / std::max(1, steps);
  if (std::abs(change) <= 0.08 * spec.ring_pitch)
    return {count, steps > 0 ? spec.ring_pitch + change : spec.ring_pitch};
  constexpr int fewest = 2;  // of which one takes a cable on either side
  const int fewer = std::max(fewest, spare < 0 ? count - 1 : count);
  const std::string shorter = number_text(filled(spec, fewer, spec.ring_pitch)),
                    longer = number_text(filled(spec, fewer + 1, spec.ring_pitch));
  throw InputError("whole rings at a pitch of " + number_text(spec.ring_pitch) + " m do not fill a " + what + " of " +
                   number_text(length) + " m; " + shorter + " m" + (longer == shorter ? "" : " and " + longer + " m") +
                   " would do");
}

NetLayout layout_of(const RingNetSpec& spec) {
  NetLayout layout;
  layout.ring_diameter = spec.ring_diameter;
  layout.beads_per_ring = spec.beads_per_ring;
  layout.wire_diameter = spec.wire_diameter;
  const Filling across = fill(spec, spec.width, "width"), up = fill(spec, spec.height, "height");
  layout.columns = across.count, layout.pitch_across = across.pitch;
  layout.rows = up.count, layout.pitch_up = up.pitch;
  layout.crossing = spec.cable_extension > 0;
  for (const Side side : all_sides)
    layout.cables[static_cast<std::size_t>(side)] = !spec.free_net && cable_spec(spec, side).present;
  return layout;
}

/// Lower and upper cables end at the frame, lateral ones at them.
void reach_for_frame(const RingNetSpec& spec, const RingPattern& pattern, NetLayout& layout) {
  layout.cable_overhang = spec.cable_extension;
  if (spec.cable_extension > 0) return;
  const double span = (layout.columns - 1 + pattern.cable_distance) * layout.pitch_across;
  const double bead = spec.fit == NetFit::inside ? 0.51 * spec.wire_diameter : 0.0;
  layout.cable_overhang = std::max(0.0, 0.5 * (spec.width - span) - bead);
}

/// Everything that the parts of a net under construction share.
struct Builder {
  const RingNetSpec& spec;
  NetLayout layout;
  RingPose place;  // of the net's own plane
  dem::Particles& particles;
  dem::Bonds& bonds;
  Net net{};

  Builder(const RingNetSpec& s, dem::Particles& p, dem::Bonds& b)
      : spec(s), layout(layout_of(s)), particles(p), bonds(b) {
    const double left = 0.5 * (s.width - (layout.columns - 1) * layout.pitch_across);
    const double below = 0.5 * (s.height - (layout.rows - 1) * layout.pitch_up);
    place = {s.origin + left * s.across + below * s.up, s.across, s.up, s.normal};
  }

  [[nodiscard]] std::int32_t next_body() const {
    return spec.first_body + static_cast<std::int32_t>(net.rings.size() + net.cables.size());
  }

  void describe() {
    net.pattern = find_pattern(layout);
    reach_for_frame(spec, net.pattern, layout);
    net.columns = layout.columns, net.rows = layout.rows;
    net.pitch_across = layout.pitch_across, net.pitch_up = layout.pitch_up;
    net.wire_diameter = spec.wire_diameter;
    net.across = spec.across, net.up = spec.up, net.normal = spec.normal;
    net.first_bead = static_cast<dem::ParticleId>(particles.size());
    net.first_bond = bonds.size();
  }

  void add_rings() {
    WireSpec ring;
    ring.properties = spec.bead_properties();
    ring.sort = bonds.add_sort(with_wire_radius(spec.ring, spec.wire_diameter));
    for (const Polyline& line : draw_rings(layout, net.pattern)) {
      ring.line = placed(line, place);
      ring.body = next_body();
      net.rings.push_back(add_wire(ring, particles, bonds));
    }
  }

  void add_cables() {
    if (spec.free_net) return;
    const CableSorts sorts{bonds.add_sort(with_wire_radius(spec.cable, spec.wire_diameter)),
                           bonds.add_sort(with_wire_radius(spec.dissipator, spec.wire_diameter))};
    for (const Side side : cable_order) {
      const NetCable& cable = cable_spec(spec, side);
      if (!cable.present) continue;
      const auto [start, end] = cable_ends(layout, net.pattern, side);
      const Polyline line = placed(cable_line({.start = start, .end = end}, spec.wire_diameter), place);
      net.cables.push_back(
          add_cable(line, cable.support, spec.bead_properties(), sorts, next_body(), particles, bonds));
      net.cable_sides.push_back(side);
      NetLayout without = layout;
      without.cable_overhang = 0;
      const auto [first, last] = cable_ends(without, net.pattern, side);
      const std::vector<Vec3> corners = placed(Polyline{{first, last}, false}, place).points;
      net.corners.push_back({corners[0], corners[1]});
      note_dissipators(net.cables.back(), sorts.dissipator);
    }
  }

  void note_dissipators(const Wire& cable, int sort) {
    for (std::size_t b = cable.first_bond; b < cable.first_bond + cable.bonds; ++b)
      if (bonds.sort[b] == sort) net.dissipators.push_back(b);
  }

  void note_beads() {
    net.beads = particles.size() - net.first_bead;
    net.bonds = bonds.size() - net.first_bond;
    note_beads_since(net.first_bead, particles, net);
  }
};

}  // namespace

void note_beads_since(dem::ParticleId first, const dem::Particles& particles, Net& net) {
  for (dem::ParticleId bead = first; bead < particles.size(); ++bead) {
    const dem::ParticleIndex i = particles.index(bead);
    net.start.push_back(particles.position[i]);
    if (particles.state[i] == dem::ParticleState::fixed) net.fixed_beads.push_back(bead);
  }
}

double RingNetSpec::bond_limit(const dem::BondSort& sort) const {
  return dem::bond_time_step(with_wire_radius(sort, wire_diameter), bead_properties().bead_mass(), bead_inertia_scale);
}

const Wire* Net::cable(Side side) const {
  for (std::size_t k = 0; k < cables.size(); ++k)
    if (cable_sides[k] == side) return &cables[k];
  return nullptr;
}

Net build_net(const RingNetSpec& spec, dem::Particles& particles, dem::Bonds& bonds) {
  if (spec.mesh) return build_mesh_net(spec, particles, bonds);
  check(spec);
  Builder builder(spec, particles, bonds);
  builder.describe();
  builder.add_rings();
  builder.add_cables();
  builder.note_beads();
  require(smallest_wire_gap(centre_lines(builder.net, particles), spec.wire_diameter) >= 0,
          "wires of a new net overlap");
  return builder.net;
}

std::vector<Polyline> centre_lines(const Net& net, const dem::Particles& particles) {
  std::vector<Polyline> lines;
  for (const Wire& ring : net.rings) lines.push_back(centre_line(ring, particles));
  for (const Wire& cable : net.cables) lines.push_back(centre_line(cable, particles));
  return lines;
}

}  // namespace lahar::barrier
