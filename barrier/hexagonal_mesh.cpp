#include "barrier/hexagonal_mesh.h"

#include <cmath>
#include <numbers>

#include "barrier/link.h"
#include "core/check.h"
#include "core/number_text.h"

namespace lahar::barrier {

namespace {

void check(const HexagonalMesh& m) {
  if (!(m.mesh_width > 0 && m.wire_diameter > 0 && m.wire_density > 0 && m.node_diameter > 0))
    throw InputError("a hexagonal mesh needs a width, a wire, a density and nodes above 0");
  if (!(m.twist_length > 0 && m.twist_length < m.mesh_height))
    throw InputError("a twist of " + number_text(m.twist_length) + " m does not fit into meshes of " +
                     number_text(m.mesh_height) + " m height: it must be shorter");
  if (m.node_diameter >= std::min(m.twist_length, m.single_length()))
    throw InputError("nodes of " + number_text(m.node_diameter) + " m touch: twists are " +
                     number_text(m.twist_length) + " m long, single wires " + number_text(m.single_length()) + " m");
}

/// Numbers of nodes: those of row j lie before those of row j + 1, the lower end of each twist before its upper end.
struct Lattice {
  int columns, rows;
  [[nodiscard]] static bool aside(int row) { return row % 2 == 1; }
  [[nodiscard]] int twists(int row) const { return aside(row) ? columns : columns + 1; }
  [[nodiscard]] int node(int row, int twist, bool upper) const {
    const int twists_below = (row + 1) / 2 * (columns + 1) + row / 2 * columns;
    return 2 * (twists_below + twist) + (upper ? 1 : 0);
  }
};

}  // namespace

double HexagonalMesh::single_length() const { return std::hypot(0.5 * mesh_width, 0.5 * (mesh_height - twist_length)); }

double HexagonalMesh::node_mass() const {
  return wire_density * std::numbers::pi / 4 * wire_diameter * wire_diameter * (twist_length + single_length());
}

dem::BondSort wire_law_bond(const WireLaw& law, double length, const HexagonalMesh& mesh) {
  std::array<double, 3> slope{};
  double strain = 0, force = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    if (!(law.strain[k] > strain && law.force[k] > force))
      throw InputError("the tensile law of a wire does not rise in strain and force from point to point");
    slope[k] = (law.force[k] - force) / (law.strain[k] - strain);
    constexpr double rounding = 1e-9;
    if (k > 0 && slope[k] > slope[k - 1] * (1 + rounding))
      throw InputError("the tensile law of a wire is steeper after a point than before it");
    if (k == 1 && mesh.plastic_unloading && slope[1] > slope[0] * (1 - rounding))  // see dem/bonds/axial_law.h
      throw InputError("the tensile law of a wire that unloads plastically goes on straight after its first point");
    strain = law.strain[k], force = law.force[k];
  }
  dem::BondSort sort = link_bond(slope[0] / length, 0.5 * mesh.node_diameter);
  const double area = std::numbers::pi * sort.bond_radius * sort.bond_radius;
  for (std::size_t k = 0; k < 3; ++k) sort.axial.stiffness[k] = slope[k] / length / area;
  sort.axial.force_limit = {law.force[0], law.force[1]};
  sort.axial.plastic_unloading = mesh.plastic_unloading;
  sort.axial.tension_only = true;
  sort.tensile_strength = law.force[2] / area;
  sort.damping_ratio = mesh.damping_ratio;
  return sort;
}

MeshPart add_hexagonal_mesh(const HexagonalMesh& mesh, int columns, int rows, const MeshPlace& place, int material,
                            std::int32_t body, dem::Particles& particles, dem::Bonds& bonds) {
  check(mesh);
  require(columns > 0 && rows > 0, "a panel of hexagonal mesh needs a column and a row");
  MeshPart part;
  part.columns = columns, part.rows = rows;
  part.first_node = static_cast<dem::ParticleId>(particles.size());
  part.first_bond = bonds.size();
  const Lattice lattice{columns, rows};
  const auto node = [&](int row, int twist, bool upper) {
    return part.first_node + static_cast<dem::ParticleId>(lattice.node(row, twist, upper));
  };
  const double volume = std::numbers::pi / 6 * std::pow(mesh.node_diameter, 3);
  for (int row = 0; row < rows; ++row)
    for (int twist = 0; twist < lattice.twists(row); ++twist)
      for (const bool upper : {false, true}) {
        const double x = mesh.mesh_width * (twist + (Lattice::aside(row) ? 0.5 : 0.0));
        const double y = row * mesh.row_distance() + (upper ? mesh.twist_length : 0.0);
        const auto i = particles.add({.position = place.corner + x * place.across + y * place.up,
                                      .radius = 0.5 * mesh.node_diameter,
                                      .density = mesh.node_mass() / volume,
                                      .material = material,
                                      .kind = dem::ParticleKind::bead,
                                      .body = body});
        if (row == 0 && !upper) part.lower.push_back(i);
        if (row + 1 == rows && upper) part.upper.push_back(i);
        if (!Lattice::aside(row) && twist == 0) part.left.push_back(i);
        if (!Lattice::aside(row) && twist == columns) part.right.push_back(i);
      }
  part.nodes = particles.size() - part.first_node;
  const int single = bonds.add_sort(wire_law_bond(mesh.single, mesh.single_length(), mesh));
  const int twisted = bonds.add_sort(wire_law_bond(mesh.twist, mesh.twist_length, mesh));
  for (int row = 0; row < rows; ++row)
    for (int twist = 0; twist < lattice.twists(row); ++twist)
      bonds.add({node(row, twist, false), node(row, twist, true), twisted}, particles);
  for (int row = 0; row + 1 < rows; ++row)
    for (int twist = 0; twist < lattice.twists(row); ++twist)
      for (const int next : {twist - (Lattice::aside(row) ? 0 : 1), twist + (Lattice::aside(row) ? 1 : 0)})
        if (next >= 0 && next < lattice.twists(row + 1))
          bonds.add({node(row, twist, true), node(row + 1, next, false), single}, particles);
  part.bonds = bonds.size() - part.first_bond;
  return part;
}

}  // namespace lahar::barrier
