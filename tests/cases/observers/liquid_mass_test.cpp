// The ledger of the liquid's mass, and what it is held against.
#include "cases/observers/liquid_mass.h"

#include "tests/cases/observers/heap_of_water.h"

namespace lahar::cases {
namespace {

using LiquidMassOfHeap = HeapOfWater;

constexpr double kStart = 1000 * 0.4 * 0.16 * 0.3;

/// The far end is open and near, gravity pulls towards it.
TEST_F(LiquidMassOfHeap, LeavesThroughAnOpenFace) {
  const Metrics first =
      first_row({"domain.open_faces=[\"x+\", \"z+\"]", "domain.upper_m=[0.42, 0.16, 0.5]", "measure.section_x_m=0.2"});
  // Liquid under its own weight is compressed: by 1.1 % at a speed of sound of 11.5 m/s.
  EXPECT_NEAR(first.at("liquid_mass_start_kg"), 1.011 * kStart, 1e-3 * kStart);
  EXPECT_EQ(first.at("liquid_left_kg"), 0);
  EXPECT_FALSE(first.contains("liquid_inflow_kg"));
  EXPECT_FALSE(first.contains("liquid_wall_balance_kg"));
  const Metrics metrics = take_row(200);
  EXPECT_GT(metrics.at("liquid_left_kg"), 0.01 * kStart);
  EXPECT_EQ(metrics.at("liquid_left_kg"), simulation_->fluid()->transfers().left);
  EXPECT_NEAR(metrics.at("liquid_mass_start_kg"), first.at("liquid_mass_start_kg"), 1e-9 * kStart);
  EXPECT_LT(metrics.at("liquid_mass_drift_rel"), 1e-10);
}

/// The heap runs against the far end and splashes: drops without neighbours go through the pool, a little of the whole.
TEST_F(LiquidMassOfHeap, TellsWhatWentThroughThePool) {
  EXPECT_EQ(first_row().at("liquid_pooled_kg"), 0);
  Metrics metrics;
  for (int k = 0; k < 20 && simulation_->fluid()->transfers().pooled == 0; ++k) metrics = take_row(200);  // it splashes
  if (simulation_->fluid()->transfers().pooled == 0) GTEST_SKIP() << "no drop was left alone on this machine";
  EXPECT_EQ(metrics.at("liquid_pooled_kg"), simulation_->fluid()->transfers().pooled);
  EXPECT_LT(metrics.at("liquid_pooled_kg"), 0.01 * kStart);
}

TEST_F(LiquidMassOfHeap, IsHeldAgainstItsStart) {
  first_row();
  const LiquidMass& ledger = *observers_->find<LiquidMass>();
  const auto check = [&](double drift) { return ledger.checks({{"liquid_mass_drift_rel", drift}}).at(0); };
  EXPECT_EQ(check(0).name, "liquid_mass_ledger");
  EXPECT_TRUE(check(1e-4).pass);
  EXPECT_FALSE(check(1.1e-4).pass);
  EXPECT_TRUE(ledger.checks({}).empty());
}

}  // namespace
}  // namespace lahar::cases
