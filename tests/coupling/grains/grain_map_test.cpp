#include "coupling/grains/grain_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/memory_archive.h"
#include "coupling/grains/sphere_rows.h"
#include "tests/coupling/tanks.h"

namespace lahar::coupling {
namespace {

void near(double /*radius*/, GridSphere<double>& s) { s.surface = -2, s.reach = covered_reach(s); }

class GrainMapTest : public testing::Test {
 protected:
  GrainMapTest() : fluid_(stream(24, 1, 1)) {
    fluid_.fill_everything([](const Vec3&) { return Vec3(Vec3::Zero()); }, [](const Vec3&) { return 0.0; });
    particles_.add(grain(Vec3(4, 4, 4), 2, 2500));      // within a block
    particles_.add(grain(Vec3(8.1, 12, 12), 2, 2500));  // in two
    particles_.add(grain(Vec3(0.3, 12, 20), 2, 2500));  // across the face of the periodic box
  }
  void update() { map_.update(fluid_, particles_, near); }

  lbm::Fluid<double> fluid_;
  dem::Particles particles_;
  GrainMap<double> map_;
};

TEST_F(GrainMapTest, FindsTheBlocksInReachAndTheExactVolume) {
  update();
  ASSERT_EQ(map_.grains().size(), 3U);
  EXPECT_EQ(map_.grains()[0].pairs, 1U);
  EXPECT_EQ(map_.grains()[1].pairs, 2U);
  EXPECT_EQ(map_.grains()[2].pairs, 2U);
  EXPECT_EQ(map_.pairs()[map_.grains()[2].first_pair].lowest.x(), -8);  // as the grain sees it
  for (const MappedGrain& g : map_.grains()) {
    double volume = 0;
    for (std::size_t p = g.first_pair; p < g.first_pair + g.pairs; ++p) volume += map_.pairs()[p].volume;
    EXPECT_NEAR(volume, 4.0 / 3.0 * std::numbers::pi * 8, 1e-9);
  }
}

/// A grain that reaches into a block which is not there yet is as large as it will be when the block is.
TEST(GrainMap, VolumesDoNotDependOnWhichBlocksExist) {
  lbm::FluidOptions options = tank(Vec3(16, 16, 16), 1, 1);
  const auto volume_below = [&](double depth) {  // of the grain, in the lower blocks
    lbm::Fluid<double> fluid(options);
    fluid.fill({{Vec3::Zero(), Vec3(16, 16, depth)}});
    dem::Particles particles;
    particles.add(grain(Vec3(4.2, 4.4, 7.9), 1.5, 2500));
    GrainMap<double> map;
    map.update(fluid, particles, near);
    return map.pairs()[map.grains()[0].first_pair].volume;
  };
  EXPECT_EQ(volume_below(5), volume_below(15));
}

/// Volume of the first grain in cells that are no wall, of a box of 16 cells with a wall, full but for a layer;
/// `periodic`: along x.
double volume_outside_of_walls(double radius, const Vec3& place, const Shape& wall, bool periodic = false) {
  lbm::FluidOptions options = tank(Vec3(16, 16, 16), 1, 1);
  if (periodic) options.domain.faces[0] = options.domain.faces[1] = lbm::FaceKind::periodic;
  options.domain.walls.add({"wall", wall});
  lbm::Fluid<double> fluid(options);
  fluid.fill({{Vec3::Zero(), Vec3(16, 16, 14)}});
  dem::Particles particles;
  particles.add(grain(place, radius, 2500));
  GrainMap<double> map;
  map.update(fluid, particles, near);
  double sum = 0;
  for (const GrainInBlock& pair : map.pairs()) {
    const auto& block = fluid.grid().block(pair.block);
    for_covered_rows(map.sphere(0), pair.lowest, [&](int row, const Row<double>& eps) {
      for (std::size_t c = 0; c < 8; ++c)
        if (block.type[static_cast<std::size_t>(row) + c] != lbm::CellType::wall) sum += eps[c];
    });
  }
  return sum;
}

/// What is spread beyond the surface of a grain stays out of the walls that it lies on; a grain that stands in a wall
/// has what is left of it outside.
TEST(GrainMap, GrainsAtWallsKeepTheirVolume) {
  const auto volume = [](double r) { return 4.0 / 3 * std::numbers::pi * r * r * r; };
  const HalfSpace bed{Vec3(0, 0, 2), Vec3::UnitZ()}, slope{Vec3(8, 8, 3), Vec3(-0.5, 0, std::sqrt(0.75))};
  for (const double r : {0.25, 0.5, 1.0, 2.3}) {
    EXPECT_NEAR(volume_outside_of_walls(r, Vec3(8.3, 7.9, 2 + r), bed), volume(r), 1e-9) << r;
    EXPECT_NEAR(volume_outside_of_walls(r, Vec3(r, r, 2 + r), bed), volume(r), 1e-9) << r;  // in a corner
    EXPECT_NEAR(volume_outside_of_walls(r, slope.point + Vec3(0.2, 0.4, 0.2 / std::sqrt(3)) + r * slope.normal, slope),
                volume(r), 1e-9)
        << r;
    EXPECT_NEAR(volume_outside_of_walls(r, Vec3(8.3, 7.9, 2), bed), volume(r) / 2, 1e-9) << r;  // half in the bed
  }
}

/// One that is sunk in several walls, too; a face of the domain in the plane of a wall is the same wall.
TEST(GrainMap, GrainsSunkInSeveralWallsHaveWhatIsLeft) {
  const auto volume = [](double r) { return 4.0 / 3 * std::numbers::pi * r * r * r; };
  const HalfSpace bed{Vec3(0, 0, 2), Vec3::UnitZ()}, between{Vec3(0, 0, 2.7), Vec3::UnitZ()},
      floor{Vec3::Zero(), Vec3::UnitZ()}, ceiling{Vec3(0, 0, 3), -Vec3::UnitZ()};
  const SolidBox step{Vec3(8, -1, -1), Vec3(16, 17, 17)};
  for (const double r : {0.25, 0.5, 1.0, 2.3}) {
    EXPECT_NEAR(volume_outside_of_walls(r, Vec3(8.3, 0, 2), bed), volume(r) / 4, 1e-9) << r;  // an edge
    EXPECT_NEAR(volume_outside_of_walls(r, Vec3(0, 0, 2), bed), volume(r) / 8, 1e-9) << r;    // a corner
    EXPECT_NEAR(volume_outside_of_walls(r, Vec3(8.3, 7.9, 0), floor), volume(r) / 2, 1e-9) << r;
    for (const double x : {8.0, 24.0})  // the image inside has the step's walls
      EXPECT_NEAR(volume_outside_of_walls(r, Vec3(x, 8, 0), step, true), volume(r) / 4, 1e-9) << r << ' ' << x;
  }
  for (const double r : {1.0, 2.3})  // a corner between the lattice's
    EXPECT_NEAR(volume_outside_of_walls(r, Vec3(0, 0, 2.7), between), volume(r) / 8, 1e-9) << r;
  // A slot of two thirds of the diameter takes two caps off, 14.8 %.
  const double in_slot = volume_outside_of_walls(2.25, Vec3(8.3, 7.9, 1.5), ceiling);
  EXPECT_NEAR(in_slot / volume(2.25), 1 - 4.0 / 27, 0.01);
}

TEST_F(GrainMapTest, TellsWhatChanged) {
  update();
  particles_.velocity.set(0, Vec3(0.1, 0, 0));
  particles_.position.add(1, Vec3(0, 0.01, 0));
  update();
  EXPECT_EQ(map_.grains()[0].change, GrainChange::motion);
  EXPECT_EQ(map_.grains()[1].change, GrainChange::place);
  EXPECT_EQ(map_.grains()[2].change, GrainChange::none);
  const auto block_of = [&](std::size_t k) {
    return static_cast<std::size_t>(map_.pairs()[map_.grains()[k].first_pair].block);
  };
  EXPECT_FALSE(map_.is_unchanged(block_of(0)));
  EXPECT_TRUE(map_.is_unchanged(block_of(2)));
  particles_.remove(2);
  update();
  EXPECT_EQ(map_.grains().size(), 2U);
  map_.forget();
  update();
  EXPECT_EQ(map_.grains()[0].change, GrainChange::place);
  update();
  EXPECT_EQ(map_.grains()[0].change, GrainChange::none);
}

TEST_F(GrainMapTest, IsTheSameAfterACheckpoint) {
  update();
  StoredState state = state_of(map_);
  GrainMap<double> loaded;
  load_state(state, loaded);
  EXPECT_TRUE(differing_lists(state, state_of(loaded)).empty());
  loaded.update(fluid_, particles_, near);
  for (const MappedGrain& g : loaded.grains()) EXPECT_EQ(g.change, GrainChange::none);
}

}  // namespace
}  // namespace lahar::coupling
