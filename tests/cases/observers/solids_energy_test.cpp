// Where the energy of grains and barrier went, and that the books close.
#include "cases/observers/solids_energy.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "cases/observers/observer_list.h"
#include "tests/cases/observers/small_net.h"

namespace lahar::cases {
namespace {

bool passes(const std::vector<ResultCheck>& checks) {
  const auto found =
      std::find_if(checks.begin(), checks.end(), [](const auto& c) { return c.name == "solids_energy_ledger"; });
  EXPECT_NE(found, checks.end());
  return found != checks.end() && found->pass;
}

/// A net that swings under its weight: all that it falls is stored, or lost in bonds, contacts and friction.
TEST_F(SmallNet, EnergyOfASwingingNetIsBooked) {
  SeriesWriter series(scratch_.path() / "series.h5");
  observers_.declare(series);
  dem::Solids& solids = *simulation_->solids();
  const double before = solids.ledger().stored();
  observers_.sample(series);
  for (int k = 0; k < 2000; ++k) simulation_->advance();
  observers_.sample(series);
  const Metrics metrics = observers_.metrics();
  const dem::EnergyLedger now = solids.ledger();
  const double lost = now.friction + now.contact_damping + now.bonds.dissipated();
  EXPECT_GT(lost, 0);
  EXPECT_NEAR(1000 * metrics.at("solids_friction_kJ"), now.friction, 1e-12);
  EXPECT_NEAR(1000 * metrics.at("solids_damping_kJ"), now.contact_damping, 1e-12);
  EXPECT_EQ(metrics.at("solids_work_kJ"), 0);
  EXPECT_NEAR(metrics.at("solids_energy_gap_max_J"), std::abs(now.stored() + lost - before), 1e-9);
  EXPECT_LT(metrics.at("solids_energy_gap_max_J"), 0.02 * lost);
  EXPECT_NEAR(metrics.at("solids_energy_turned_over_max_J"), now.kinetic + now.rotational + lost, 1e-9);
  EXPECT_TRUE(passes(observers_.checks()));
}

/// Twice their speed comes from nowhere, as from steps that are too long.
TEST_F(SmallNet, EnergyFromNowhereFailsTheCheck) {
  SeriesWriter series(scratch_.path() / "series.h5");
  observers_.declare(series);
  observers_.sample(series);
  for (int k = 0; k < 1000; ++k) simulation_->advance();
  observers_.sample(series);
  EXPECT_TRUE(passes(observers_.checks()));
  dem::Particles& p = simulation_->solids()->particles();
  for (std::size_t i = 0; i < p.size(); ++i) p.velocity.set(i, 2 * p.velocity[i]);
  observers_.sample(series);
  EXPECT_FALSE(passes(observers_.checks()));
}

/// Work of outside forces is no gap; what the run before the first row lost does not count.
TEST_F(SmallNet, WorkFromOutsideIsBooked) {
  dem::Solids& solids = *simulation_->solids();
  for (int k = 0; k < 100; ++k) simulation_->advance();
  const double before = solids.ledger().dissipated();
  EXPECT_GT(before, 0);
  SeriesWriter series(scratch_.path() / "series.h5");
  observers_.declare(series);
  observers_.sample(series);
  EXPECT_EQ(observers_.metrics().at("solids_friction_kJ"), 0);
  dem::Particles& p = solids.particles();
  const double push = 0.1;  // N, on each free bead
  for (std::size_t i = 0; i < p.size(); ++i)
    if (p.inverse_mass[i] > 0) p.external_force.set(i, Vec3(push, 0, 0));
  for (int k = 0; k < 500; ++k) simulation_->advance();
  observers_.sample(series);
  const Metrics metrics = observers_.metrics();
  EXPECT_GT(metrics.at("solids_work_kJ"), 0);
  EXPECT_LT(metrics.at("solids_energy_gap_max_J"), 0.02 * 1000 * metrics.at("solids_work_kJ"));
}

}  // namespace
}  // namespace lahar::cases
