#include "barrier/hexagonal_mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

#include "core/check.h"
#include "dem/bonds/bond_forces.h"

namespace lahar::barrier {
namespace {

HexagonalMesh mesh() {
  HexagonalMesh m;
  m.mesh_width = 0.08, m.mesh_height = 0.12, m.twist_length = 0.04;
  m.wire_diameter = 0.0027, m.wire_density = 7850, m.node_diameter = 0.0216;
  m.single = {{0.00192, 0.05, 0.35}, {1431, 2192, 3240}};
  m.twist = {{0.00192, 0.02, 0.14}, {2862, 4384, 6480}};
  return m;
}

TEST(HexagonalMesh, IsAHoneycomb) {
  for (const int rows : {1, 2, 5}) {
    dem::Particles p;
    dem::Bonds b;
    const MeshPart part = add_hexagonal_mesh(mesh(), 3, rows, {}, 0, 7, p, b);
    const int twists = (rows + 1) / 2 * 4 + rows / 2 * 3;
    EXPECT_EQ(part.nodes, static_cast<std::size_t>(2 * twists));
    EXPECT_EQ(part.bonds, static_cast<std::size_t>(twists + 6 * (rows - 1)));
    std::map<dem::ParticleIndex, int> wires;
    for (std::size_t k = 0; k < b.size(); ++k) {
      const bool twist = std::abs(b.rest_length[k] - 0.04) < 1e-12;
      EXPECT_TRUE(twist || std::abs(b.rest_length[k] - std::hypot(0.04, 0.04)) < 1e-12) << b.rest_length[k];
      ++wires[b.i[k]], ++wires[b.j[k]];
    }
    EXPECT_EQ(part.lower.size(), 4u);
    EXPECT_EQ(part.upper.size(), rows % 2 == 1 ? 4u : 3u);
    EXPECT_EQ(part.left.size(), static_cast<std::size_t>((rows + 1) / 2 * 2));
    const double top = (rows - 1) * mesh().row_distance() + mesh().twist_length;
    for (const auto& [node, count] : wires) {
      const Vec3 x = p.position[node];
      const bool edge = x.y() < 1e-9 || x.y() > 0.24 - 1e-9 || x.z() < 1e-9 || x.z() > top - 1e-9;
      EXPECT_TRUE(edge || count == 3) << x.transpose();
    }
  }
}

TEST(HexagonalMesh, NodesCarryTheMassOfTheWire) {
  // In an endless mesh a node has half a twist, which is two wires, and two halves of single wires.
  EXPECT_NEAR(mesh().node_mass(), 7850 * std::numbers::pi / 4 * 0.0027 * 0.0027 * (0.04 + std::hypot(0.04, 0.04)),
              1e-12);
  dem::Particles p;
  dem::Bonds b;
  add_hexagonal_mesh(mesh(), 2, 2, {}, 0, 0, p, b);
  EXPECT_NEAR(p.mass[0], mesh().node_mass(), 1e-12);
}

TEST(HexagonalMesh, WireFollowsItsLaw) {
  const dem::BondSort sort = wire_law_bond(mesh().single, 0.05, mesh());
  const double area = std::numbers::pi * sort.bond_radius * sort.bond_radius;
  const dem::AxialLaw& law = sort.axial;
  EXPECT_NEAR(law.stiffness[0] * area * 0.00192 * 0.05, 1431, 1e-6);
  EXPECT_NEAR(1431 + law.stiffness[1] * area * (0.05 - 0.00192) * 0.05, 2192, 1e-6);
  EXPECT_NEAR(2192 + law.stiffness[2] * area * 0.3 * 0.05, 3240, 1e-6);
  EXPECT_NEAR(sort.tensile_strength * area, 3240, 1e-6);
  EXPECT_TRUE(law.tension_only);
}

/// A wire that goes on straight after a point follows its law, but plastic unloading needs a softer second piece.
TEST(HexagonalMesh, PiecesOfALawMayBeAsSteepAsTheOneBefore) {
  HexagonalMesh m = mesh();
  m.single = {{0.01, 0.02, 0.1}, {100, 200, 300}};
  EXPECT_THROW((void)wire_law_bond(m.single, 0.05, m), InputError);
  m.plastic_unloading = false;
  const dem::BondSort sort = wire_law_bond(m.single, 0.05, m);
  const dem::AxialCurve curve = dem::axial_curve(sort.axial, std::numbers::pi * sort.bond_radius * sort.bond_radius);
  EXPECT_NEAR(dem::curve_force(curve, 0.015 * 0.05), 150, 1e-9);
  EXPECT_NEAR(dem::curve_force(curve, 0.06 * 0.05), 250, 1e-9);
  m.single = {{0.01, 0.02, 0.1}, {100, 200, 900}};
  EXPECT_NO_THROW((void)wire_law_bond(m.single, 0.05, m));
  m.single = {{0.01, 0.02, 0.1}, {100, 200, 2000}};
  EXPECT_THROW((void)wire_law_bond(m.single, 0.05, m), InputError);
}

/// A node may spin as often as it likes: a wire that is slack in bending does not break by it.
TEST(HexagonalMesh, SpinOfNodesBreaksNoWire) {
  dem::Particles p;
  dem::Bonds b;
  p.add({.position = Vec3::Zero(), .radius = 0.0108, .density = 7850, .state = dem::ParticleState::fixed});
  p.add({.position = Vec3(0.05, 0, 0), .radius = 0.0108, .density = 7850});
  b.add({0, 1, b.add_sort(wire_law_bond(mesh().single, 0.05, mesh()))}, p);
  dem::BondForces forces;
  forces.build(b, p);
  p.angular_velocity.set(1, Vec3(0, 500, 0));
  for (int step = 0; step < 1000; ++step) {
    p.force.fill(Vec3::Zero()), p.torque.fill(Vec3::Zero());
    forces.add_forces(b, p, 1e-3);
  }
  EXPECT_TRUE(b.intact[0]);
  EXPECT_EQ(p.torque[1].norm(), 0);
}

TEST(HexagonalMesh, RefusesLawsAndMeshesThatMakeNoSense) {
  HexagonalMesh m = mesh();
  m.single.force[1] = 1000;
  EXPECT_THROW((void)wire_law_bond(m.single, 0.05, m), InputError);
  m.single = {{0.01, 0.02, 0.03}, {100, 300, 400}};  // stiffens
  EXPECT_THROW((void)wire_law_bond(m.single, 0.05, m), InputError);
  dem::Particles p;
  dem::Bonds b;
  m = mesh();
  m.twist_length = 0.13;
  EXPECT_THROW(add_hexagonal_mesh(m, 2, 2, {}, 0, 0, p, b), InputError);
  m = mesh();
  m.node_diameter = 0.041;
  EXPECT_THROW(add_hexagonal_mesh(m, 2, 2, {}, 0, 0, p, b), InputError);
}

}  // namespace
}  // namespace lahar::barrier
