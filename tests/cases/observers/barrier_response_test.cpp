// What is seen of a net, and of rings that have gone through each other.
#include "cases/observers/barrier_response.h"

#include <gtest/gtest.h>

#include "cases/observers/observer_list.h"
#include "cases/observers/ring_links.h"
#include "tests/cases/scene/scene_files.h"

namespace lahar::cases {
namespace {

class SmallNet : public testing::Test {
 protected:
  scene::Scene scene_ = scene::load(scene::case_file("hanging_net/scene.toml"),
                                    {"barrier.net.width_m=0.38", "barrier.net.height_m=0.26"});
  std::unique_ptr<Simulation> simulation_ = build_simulation(scene_);
  ObserverList observers_{scene_, *simulation_};
  scene::ScratchFolder scratch_;
};

TEST_F(SmallNet, LoadsOfItsParts) {
  SeriesWriter series(scratch_.path() / "series.h5");
  observers_.declare(series);
  for (int s = 0; s < 20; ++s) simulation_->advance();
  observers_.sample(series);
  const dem::Solids& solids = *simulation_->solids();
  const auto r = barrier::response(*simulation_->net(), solids.particles(), solids.bonds(), scene_.gravity.vector());
  ASSERT_GT(r[barrier::Component::rings].force_sum, 0);
  const Metrics metrics = observers_.metrics();
  EXPECT_EQ(metrics.at("peak_rings_sum_kN"), r[barrier::Component::rings].force_sum / 1000);
  EXPECT_EQ(metrics.at("peak_barrier_tension_kN"), r[barrier::Component::barrier].max_tension / 1000);
  EXPECT_EQ(metrics.at("max_elongation_m"), std::max(0.0, r.elongation));
  EXPECT_FALSE(metrics.contains("peak_mesh_sum_kN"));
  observers_.finish(scratch_.path());
  EXPECT_TRUE(std::filesystem::exists(scratch_.path() / "cable_forces.png"));
}

TEST_F(SmallNet, ALostLinkIsToldOf) {
  EXPECT_TRUE(observers_.warnings().empty());
  ASSERT_EQ(observers_.checks().size(), 1u);
  EXPECT_TRUE(observers_.checks()[0].pass);
  dem::Particles& p = simulation_->solids()->particles();
  const auto ring = p.body[p.size() / 2];
  for (std::size_t i = 0; i < p.size(); ++i)
    if (p.body[i] == ring) p.position.x[i] += 10;
  ASSERT_EQ(observers_.warnings().size(), 1u);
  EXPECT_FALSE(observers_.checks()[0].pass);
}

}  // namespace
}  // namespace lahar::cases
