#include "barrier/mesh_net.h"

#include <cmath>
#include <numbers>

#include "barrier/link.h"
#include "core/check.h"

namespace lahar::barrier {

namespace {

/// From the frame to the nodes at the edge: a cable and a little air.
double margin(const RingNetSpec& spec) { return 1.05 * spec.wire_diameter + 0.5 * spec.mesh->node_diameter; }

/// `count` pieces of `step`, and `fixed` metres more, stretched to fill a length.
struct Filling {
  int count;
  double stretch;  ///< factor on `step` and on `fixed`
};

Filling fill(double length, double step, double fixed, int least, double edges, const std::string& what) {
  const double inside = length - edges;
  const int count = std::max(least, static_cast<int>(std::lround((inside - fixed) / step)));
  const double stretch = inside / (count * step + fixed);
  if (std::abs(stretch - 1) <= 0.08) return {count, stretch};
  const int fewer = std::max(least, static_cast<int>(std::floor((inside - fixed) / step)));
  const auto size = [&](int n) { return std::to_string(n * step + fixed + edges) + " m"; };
  throw InputError("whole meshes do not fill a " + what + " of " + std::to_string(length) + " m; " + size(fewer) +
                   " and " + size(fewer + 1) + " would do");
}

void tie_to_nearest(const std::vector<dem::ParticleId>& nodes, const Wire& cable, int sort, Net& net,
                    const dem::Particles& particles, dem::Bonds& bonds) {
  for (const dem::ParticleId node : nodes) {
    const Vec3 place = particles.position[particles.index(node)];
    const auto away = [&](dem::ParticleId bead) { return (particles.position[particles.index(bead)] - place).norm(); };
    dem::ParticleId nearest = cable.first_bead;
    for (dem::ParticleId i = nearest; i < cable.first_bead + cable.beads; ++i)
      if (away(i) < away(nearest)) nearest = i;
    net.ties.push_back(bonds.size());
    bonds.add({node, nearest, sort}, particles);
  }
}

/// A cable of the frame, with the nodes that are tied to it.
struct Edge {
  Side side;
  const NetCable& cable;
  Vec3 start, end;  ///< m, across and up from the frame's corner
  const std::vector<dem::ParticleId>& nodes;
};

}  // namespace

Net build_mesh_net(const RingNetSpec& spec, dem::Particles& particles, dem::Bonds& bonds) {
  require(spec.mesh.has_value(), "a net of hexagonal mesh needs a mesh");
  HexagonalMesh mesh = *spec.mesh;
  const double edges = 2 * margin(spec), d = spec.wire_diameter;
  const Filling across = fill(spec.width, mesh.mesh_width, 0, 1, edges, "width");
  const Filling up = fill(spec.height, mesh.row_distance(), mesh.twist_length, 0, edges, "height");
  mesh.mesh_width *= across.stretch;
  mesh.mesh_height *= up.stretch, mesh.twist_length *= up.stretch;

  Net net;
  net.columns = across.count, net.rows = up.count + 1;
  net.pitch_across = mesh.mesh_width, net.pitch_up = mesh.row_distance();
  net.wire_diameter = d;
  net.across = spec.across, net.up = spec.up, net.normal = spec.normal;
  net.first_bead = static_cast<dem::ParticleId>(particles.size());
  net.first_bond = bonds.size();
  const Vec3 corner = spec.origin + margin(spec) * (spec.across + spec.up);
  net.meshes = {add_hexagonal_mesh(mesh, net.columns, net.rows, {corner, spec.across, spec.up}, spec.material,
                                   spec.first_body, particles, bonds)};
  const MeshPart panel = net.meshes.front();

  const dem::BondSort cable = with_wire_radius(spec.cable, d);
  const CableSorts sorts{bonds.add_sort(cable), bonds.add_sort(with_wire_radius(spec.dissipator, d))};
  const double stiffness = cable.axial.stiffness[0] * std::numbers::pi * cable.bond_radius * cable.bond_radius;
  const int tie_sort = bonds.add_sort(link_bond(stiffness, 0.5 * d));
  const double in = 0.51 * d, right = spec.width - in, top = spec.height - in, gap = 1.05 * d;
  for (const Edge& e : {Edge{Side::lower, spec.lower, {in, in, 0}, {right, in, 0}, panel.lower},
                        Edge{Side::upper, spec.upper, {in, top, 0}, {right, top, 0}, panel.upper},
                        Edge{Side::left, spec.left, {in, in + gap, 0}, {in, top - gap, 0}, panel.left},
                        Edge{Side::right, spec.right, {right, in + gap, 0}, {right, top - gap, 0}, panel.right}}) {
    if (spec.free_net || !e.cable.present) continue;
    const RingPose frame{spec.origin, spec.across, spec.up, spec.normal};
    const Polyline line = placed(cable_line({.start = e.start, .end = e.end}, d), frame);
    const auto body = spec.first_body + 1 + static_cast<std::int32_t>(net.cables.size());
    net.cables.push_back(add_cable(line, e.cable.support, spec.bead_properties(), sorts, body, particles, bonds));
    net.cable_sides.push_back(e.side);
    net.corners.push_back({line.points.front(), line.points.back()});
    const Wire& wire = net.cables.back();
    for (std::size_t b = wire.first_bond; b < wire.first_bond + wire.bonds; ++b)
      if (bonds.sort[b] == sorts.dissipator) net.dissipators.push_back(b);
    tie_to_nearest(e.nodes, wire, tie_sort, net, particles, bonds);
  }

  net.beads = particles.size() - net.first_bead;
  net.bonds = bonds.size() - net.first_bond;
  note_beads_since(net.first_bead, particles, net);
  return net;
}

}  // namespace lahar::barrier
