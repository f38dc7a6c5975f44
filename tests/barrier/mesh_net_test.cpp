#include "barrier/mesh_net.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "barrier/response.h"
#include "barrier/spans.h"
#include "core/check.h"
#include "dem/solids.h"
#include "dem/time_step.h"

namespace lahar::barrier {
namespace {

RingNetSpec panel() {
  RingNetSpec s;
  HexagonalMesh m;
  m.mesh_width = 0.08, m.mesh_height = 0.12, m.twist_length = 0.04;
  m.wire_diameter = 0.0027, m.wire_density = 7850, m.node_diameter = 0.0216;
  m.single = {{0.00192, 0.05, 0.35}, {1431, 2192, 3240}};
  m.twist = {{0.00192, 0.02, 0.14}, {2862, 4384, 6480}};
  s.mesh = m;
  s.wire_diameter = 0.008, s.width = 0.44, s.height = 0.4;
  return s;
}

TEST(MeshNet, FillsItsFrame) {
  dem::Particles p;
  dem::Bonds b;
  const Net net = build_net(panel(), p, b);
  EXPECT_EQ(net.columns, 5);
  EXPECT_EQ(net.rows, 5);
  EXPECT_EQ(net.cables.size(), 4u);
  EXPECT_TRUE(net.rings.empty());
  const MeshPart& mesh = net.meshes.at(0);
  EXPECT_EQ(net.ties.size(), mesh.left.size() + mesh.right.size() + mesh.lower.size() + mesh.upper.size());
  double least = 1;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const double y = p.position.y[i], z = p.position.z[i], r = p.radius[i];
    least = std::min({least, y - r, 0.44 - y - r, z - r, 0.4 - z - r});
    for (std::size_t j = 0; j < i; ++j) {
      const bool one = p.body[i] == p.body[j];
      ASSERT_TRUE(one || (p.position[i] - p.position[j]).norm() > r + p.radius[j] - 1e-12) << i << " and " << j;
    }
  }
  EXPECT_GT(least, 0);
  EXPECT_LT(least, 1e-3);
}

TEST(MeshNet, NamesSizesThatWholeMeshesFill) {
  RingNetSpec s = panel();
  s.width = 0.17;
  dem::Particles p;
  dem::Bonds b;
  try {
    build_net(s, p, b);
    FAIL() << "0.17 m were accepted";
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("0.118400 m and 0.198400 m would do"), std::string::npos) << e.what();
  }
}

TEST(MeshNet, HangsBetweenPostsAndHoldsAPush) {
  SpansSpec s;
  s.net = panel();
  for (dem::BondSort* sort : {&s.net.cable, &s.net.dissipator}) sort->damping_ratio = 0.05;
  s.spans = 2, s.post_height = 0.42, s.post_diameter = 0.05;
  s.section = {.youngs_modulus = 210e9, .area = 7e-4, .second_moment = 1.8e-7, .density = 7850};
  s.elements.of<RetainingCable>() = {{.post = 1, .anchor = {-0.4, 0, 0}, .dissipators_at = {}}};
  dem::Particles p;
  dem::Bonds b;
  const Net net = build_spans(s, p, b);
  ASSERT_EQ(net.meshes.size(), 2u);
  dem::Materials materials;
  materials.add({"steel", 1e9, 0.3});
  materials.set_pair(0, 0, 0.1, 0.5);
  dem::SolidsOptions options;
  options.gravity = Vec3::Zero();
  options.time_step = 0.5 * dem::bond_time_step(b, p);
  dem::Solids solids(std::move(p), std::move(b), materials, {}, options);
  const dem::ParticleIndex middle = net.meshes[0].first_node + static_cast<dem::ParticleIndex>(net.meshes[0].nodes / 2);
  for (int k = 0; k < 100; ++k) {
    solids.particles().external_force.set(middle, {50, 0, 0});
    solids.advance(20);
  }
  const BarrierResponse r = response(net, solids.particles(), solids.bonds(), Vec3::Zero());
  EXPECT_GT(r[Component::mesh].max_tension, 10);
  EXPECT_GT(r.elongation, 1e-4);
  EXPECT_TRUE(is_reported(Component::mesh, net));
  EXPECT_NEAR(r[Component::barrier].energy.elastic() / solids.bond_energy().elastic(), 1, 1e-9);
}

}  // namespace
}  // namespace lahar::barrier
