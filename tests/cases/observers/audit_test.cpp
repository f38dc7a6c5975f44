// Momentum between fluid and solids, on both sides of the books.
#include "cases/observers/audit.h"

#include <gtest/gtest.h>

#include "cases/observers/observer_list.h"
#include "tests/cases/scene/scene_files.h"

namespace lahar::cases {
namespace {

TEST(Audit, TellsWhatTheCoupledStepBooked) {
  const scene::Scene scene = scene::load(scene::source_folder() / "tests/cases/observers/everything.toml");
  const auto simulation = build_simulation(scene);
  const ObserverList observers(scene, *simulation);
  for (int s = 0; s < 3; ++s) simulation->advance();
  EXPECT_EQ(observers.metrics().at("momentum_audit_rel"), simulation->audit().relative());
  const Audit& audit = *observers.find<Audit>();
  EXPECT_TRUE(audit.checks(observers.metrics()).at(0).pass);
  const auto check = [&](double value) { return audit.checks({{"momentum_audit_rel", value}}).at(0); };
  EXPECT_EQ(check(0).name, "momentum_audit");
  EXPECT_TRUE(check(1e-6).pass);
  EXPECT_FALSE(check(1.1e-6).pass);
  coupling::MomentumAudit broken;
  broken.book({Vec3::Constant(kUnknown), Vec3::Constant(kUnknown)});
  EXPECT_FALSE(check(broken.relative()).pass);
  coupling::MomentumAudit of_nothing;
  EXPECT_EQ(of_nothing.relative(), 0);
  of_nothing.book({Vec3(5, 0, 0), Vec3::Zero()});  // the solids got what no cell gave
  EXPECT_FALSE(check(of_nothing.relative()).pass);
}

TEST(Audit, NeedsBothSides) {
  const scene::Scene scene = scene::load_text(scene::small_scene);
  const auto simulation = build_simulation(scene);
  EXPECT_EQ(ObserverList(scene, *simulation).find<Audit>(), nullptr);
}

}  // namespace
}  // namespace lahar::cases
