#include "coupling/solid_fields.h"

#include <gtest/gtest.h>

#include "tests/coupling/tanks.h"

namespace lahar::coupling {
namespace {

using Writer = SolidFields<double>::Writer;

class SolidFieldsTest : public testing::Test {
 protected:
  SolidFieldsTest() : fluid_(stream(16, 1, 1)) {
    fluid_.fill_everything([](const Vec3&) { return Vec3(0.01, 0, 0); }, [](const Vec3&) { return 0.0; });
  }
  lbm::FluidGrid<double>& grid() { return fluid_.grid(); }
  [[nodiscard]] lbm::BlockIndex block(std::size_t k) { return grid().owned()[k]; }
  void write(lbm::BlockIndex b, Writer writer) {
    lbm::BodyFields<double>& f = fields_.reach(grid(), b);
    f.drag[7] = f.solid_fraction[7] = 1, f.covered[0] = 1;
    fields_.set_writer(b, writer);
  }

  lbm::Fluid<double> fluid_;
  SolidFields<double> fields_;
};

TEST_F(SolidFieldsTest, StayWithOneWriterAndAreEmptiedAfterSeveral) {
  fields_.open(grid());
  write(block(0), Writer::grains), write(block(1), Writer::wires), write(block(2), Writer::several);
  fields_.write_over(grid(), block(3)).drag[3] = 1;
  fields_.open(grid());
  EXPECT_EQ(grid().block(block(0)).body->drag[7], 1);
  EXPECT_EQ(grid().block(block(1)).body->drag[7], 1);
  EXPECT_EQ(grid().block(block(2)).body->drag[7], 0);
  EXPECT_EQ(grid().block(block(2)).body->covered[0], 0);
  EXPECT_EQ(grid().block(block(3)).body->drag[3], 0);
  EXPECT_EQ(fields_.writer(block(0)), Writer::grains);
  EXPECT_EQ(fields_.writer(block(1)), Writer::wires);
  EXPECT_EQ(fields_.writer(block(2)), Writer::none);
  fields_ = {};
  fields_.open(grid());
  EXPECT_EQ(grid().block(block(0)).body->solid_fraction[7], 0);
}

TEST_F(SolidFieldsTest, GoBackWhereNobodyReaches) {
  fields_.open(grid());
  write(block(0), Writer::grains), write(block(1), Writer::grains);
  fields_.close(grid());
  fields_.open(grid());
  fields_.reach(grid(), block(0));
  fields_.close(grid());
  EXPECT_NE(grid().block(block(0)).body, nullptr);
  EXPECT_EQ(grid().block(block(1)).body, nullptr);
  EXPECT_EQ(fields_.writer(block(1)), Writer::none);
}

/// A block that was released and made again is another one.
TEST_F(SolidFieldsTest, DoNotTakeANewBlockForTheOld) {
  fields_.open(grid());
  const lbm::BlockIndex b = block(1);
  write(b, Writer::grains);
  const std::uint64_t birth = grid().block(b).birth;
  grid().block(b).birth = birth + 100;
  fields_.open(grid());
  EXPECT_EQ(fields_.writer(b), Writer::none);
  EXPECT_EQ(grid().block(b).body->drag[7], 0);
}

/// The fluid's side of the audit: all cells, also those that no body answers for.
TEST_F(SolidFieldsTest, MomentumGivenToBodiesIsSummedOverCells) {
  fields_.open(grid());
  for (std::size_t k = 0; k < 2; ++k) {
    lbm::BodyFields<double>& f = fields_.reach(grid(), block(k));
    for (const int n : {5, 77}) f.momentum_exchange_x[n] = 0.25, f.momentum_exchange_z[n] = -1;
    f.exchange_weight[5] = 0.5;
  }
  EXPECT_EQ(momentum_given_to_bodies(grid()), Vec3(1, 0, -4));
}

}  // namespace
}  // namespace lahar::coupling
