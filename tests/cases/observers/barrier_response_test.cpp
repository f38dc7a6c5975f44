// What is seen of a net.
#include "cases/observers/barrier_response.h"

#include <gtest/gtest.h>

#include "tests/cases/observers/small_net.h"

namespace lahar::cases {
namespace {

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

}  // namespace
}  // namespace lahar::cases
