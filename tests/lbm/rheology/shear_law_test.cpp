// The flow law at a given shear rate, against its formula worked by hand.
#include "lbm/rheology/shear_law.h"

#include <gtest/gtest.h>

namespace lahar::lbm {
namespace {

TEST(ShearLaw, WaterHasOneViscosityAndNoYield) {
  const ShearLaw water = shear_law({}, 1e-6, 1000);
  EXPECT_EQ(water.viscosity_at(0), 1e-6);
  EXPECT_EQ(water.viscosity_at(1e4), 1e-6);
  EXPECT_EQ(water.bingham(0), 0);
}

TEST(ShearLaw, BinghamHasItsPlasticViscosity) {
  const ShearLaw mud = shear_law({FlowLaw::bingham, 100, 0, 1, 10}, 1e-3, 1000);
  EXPECT_EQ(mud.viscosity_at(4), 1e-3);
  EXPECT_NEAR(mud.bingham(4), 100 / (1000 * 1e-3 * 4), 1e-12);
}

/// K g^(n-1) without the yield stress, up to the limit; Bn is their ratio.
TEST(ShearLaw, HerschelBulkleyThins) {
  const ShearLaw mud = shear_law({FlowLaw::herschel_bulkley, 40, 20, 0.5, 10}, 1e-6, 2000);
  EXPECT_NEAR(mud.viscosity_at(4), 0.01 / 2, 1e-12);
  EXPECT_NEAR(mud.bingham(4), 40 / (20 * 2.0), 1e-12);
  EXPECT_EQ(mud.viscosity_at(0), 10) << "at rest the limit, not infinity";
}

TEST(ShearLaw, NoFlowIsMoreViscousThanTheLimit) {
  EXPECT_EQ(shear_law({FlowLaw::herschel_bulkley, 0, 10, 1, 1e-3}, 1e-6, 1000).viscosity_at(1), 1e-3);
}

}  // namespace
}  // namespace lahar::lbm
