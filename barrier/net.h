#pragma once
// A ring net barrier: interlocked rings in a frame, hung on four cables with dissipators and anchors (Li, Zhao & Kwan
// 2020, sections 2.1 and 4.1, Table 4).
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "barrier/cable.h"
#include "barrier/dissipator.h"
#include "barrier/hexagonal_mesh.h"
#include "barrier/pattern.h"
#include "barrier/post.h"
#include "barrier/wire.h"
#include "dem/bonds/bonds.h"
#include "dem/particles.h"

namespace lahar::barrier {

/// How the net fills its frame.
enum class NetFit {
  inside,           ///< no bead reaches beyond the frame, as between walls; the pitch gives way a little
  cables_on_frame,  ///< a ring per pitch; cables run along the frame, edge rings reach up to 1.5 wires beyond it
};

/// One cable of the net.
struct NetCable {
  bool present = true;
  CableSupport support;
};

/// What a net is made of. The defaults are the paper's net, standing across y with the flow along x.
struct RingNetSpec {
  Vec3 origin = Vec3::Zero();   ///< m, lower left corner of the frame
  Vec3 across = Vec3::UnitY();  ///< unit
  Vec3 up = Vec3::UnitZ();      ///< unit
  Vec3 normal = Vec3::UnitX();  ///< unit: direction of the flow
  double width = 1.8;           ///< m, across
  double height = 0.96;         ///< m, up
  double ring_diameter = 0.07;  ///< m, of the centre-line
  double ring_pitch = 0.06;     ///< m; a whole number of rings fills the frame, at a pitch up to 8 % away
  int beads_per_ring = 36;
  double wire_diameter = 0.0061;  ///< m, of all beads
  double density = 7800;          ///< kg/m^3, of a bead
  double bead_mass_scale = 1;     ///< inertial over gravitational mass of a bead
  double bead_inertia_scale = 1;  ///< moment of inertia of a bead over that of a sphere of its inertial mass
  int material = 0;               ///< index into dem::Materials
  NetFit fit = NetFit::inside;
  bool free_net = false;  ///< rings only: no cables, nothing fixed
  /// m, by which all four cables go on beyond the corners of the net, where they cross: room for dissipators, which
  /// draw a cable out through its guides (see guide.h). 0: cables end at the corners.
  double cable_extension = 0;
  std::int32_t first_body = 0;  ///< number of the first ring; rings come first, then the cables
  /// Bond sorts; bond_radius 0 stands for half the wire diameter.
  dem::BondSort ring = wire_bond(3e11, 0);
  dem::BondSort cable = wire_bond(8e11, 0);
  dem::BondSort dissipator = dissipator_bond(8e11, 8e10, 2000, 0);
  NetCable lower{true, {.fixed_at = {}, .fixed_all = true, .dissipators_at = {}}};
  NetCable upper{};
  NetCable left{true, {.fixed_at = {0, 0.5, 1}, .fixed_all = false, .dissipators_at = {0, 1}}};
  NetCable right{true, {.fixed_at = {0, 0.5, 1}, .fixed_all = false, .dissipators_at = {0, 1}}};
  /// In place of the rings a hexagonal mesh, whose keys above do not count but for those of frame, wire diameter and
  /// density of the cables: see mesh_net.h.
  std::optional<HexagonalMesh> mesh{};

  [[nodiscard]] WireProperties bead_properties() const {
    return {wire_diameter, density, material, bead_mass_scale, bead_inertia_scale};
  }
  /// s: the longest stable step of a bond between beads.
  [[nodiscard]] double bond_limit(const dem::BondSort& sort) const;
};

/// A net that was built: which particles, by id, and which bonds are its parts. Ids of beads and numbers of bonds of a
/// net are contiguous. A net of several spans (see spans.h) is one net: first all rings, span by span, then all cables.
struct Net {
  int spans = 1;
  int columns = 0, rows = 0;              ///< of a span
  double pitch_across = 0, pitch_up = 0;  ///< m, as built
  double wire_diameter = 0;               ///< m
  RingPattern pattern;
  Vec3 across, up, normal;                    ///< unit
  std::vector<Wire> rings;                    ///< row by row from below, from left to right
  std::vector<Wire> cables;                   ///< those present, in the order lower, upper, left, right
  std::vector<Side> cable_sides;              ///< side of each cable
  std::vector<CableEnds> corners;             ///< m, where each cable passes the corners of the net, as built
  std::vector<std::size_t> dissipators;       ///< bonds
  std::vector<MeshPart> meshes{};             ///< instead of rings: a panel a span
  std::vector<Post> posts{};                  ///< from left to right, one more than spans; none without posts
  std::vector<std::vector<Wire>> elements{};  ///< wires of what hangs on posts, by kind (elements.h)
  std::vector<std::size_t> ties{};            ///< bonds of cables to posts and of meshes to cables
  std::vector<dem::ParticleId> fixed_beads;   ///< ascending
  dem::ParticleId first_bead = 0;
  std::size_t beads = 0;
  std::size_t first_bond = 0, bonds = 0;
  Vec3Field start;  ///< m, where the beads were built

  [[nodiscard]] const Wire& ring(int column, int row) const {
    return rings[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column)];
  }
  /// The span that a ring or a cable of Net::cables belongs to.
  [[nodiscard]] std::size_t span_of_ring(std::size_t ring) const {
    return ring * static_cast<std::size_t>(spans) / rings.size();
  }
  [[nodiscard]] std::size_t span_of_cable(std::size_t cable) const {
    return cable * static_cast<std::size_t>(spans) / cables.size();
  }
  /// The cable on a side of the first span, or nullptr.
  [[nodiscard]] const Wire* cable(Side side) const;
};

/// Builds the net at rest and free of stress: every ring linked once with each neighbour beside it, edge rings threaded
/// on their cables, no two wires nearer than touching, bond lengths of the rings equal within 0.5 %. Throws InputError
/// for a spec that makes no sense, a frame that whole rings do not fill (naming sizes that do), a pitch at which rings
/// cannot interlock (naming the range that would do) or beads so far apart that rings could pass through each other.
Net build_net(const RingNetSpec& spec, dem::Particles& particles, dem::Bonds& bonds);

/// Enters the beads from an id on into Net::start and Net::fixed_beads.
void note_beads_since(dem::ParticleId first, const dem::Particles& particles, Net& net);

/// All wires of rings and cables as they lie now: rings, then cables.
[[nodiscard]] std::vector<Polyline> centre_lines(const Net& net, const dem::Particles& particles);

}  // namespace lahar::barrier
