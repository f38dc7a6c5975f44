#include "cases/files/vdb_writer.h"

#include <openvdb/openvdb.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <cstdio>

#include "cases/files/output_file.h"
#include "tests/cases/files/test_folder.h"

namespace lahar::cases {
namespace {

// Two blocks, one at negative cells; each value tells its cell.
lbm::FluidSnapshot numbered_fluid() {
  lbm::FluidSnapshot fluid{0.25, Vec3(10, 20, 30), {}};
  for (const Vec3i& origin : {Vec3i(-8, 0, 8), Vec3i(16, 8, 0)}) {
    lbm::FluidSnapshot::Block block;
    block.origin = origin;
    for (std::size_t n = 0; n < 512; ++n) {
      block.fill_level[n] = n % 3 == 0 ? 0.0F : static_cast<float>(n) / 512;
      block.velocity_x[n] = static_cast<float>(n);
      block.velocity_y[n] = -static_cast<float>(n);
      block.velocity_z[n] = static_cast<float>(origin.x());
    }
    fluid.blocks.push_back(block);
  }
  return fluid;
}

TEST(VdbWriter, ValuesTransformAndMetadataReadBack) {
  const TestFolder folder;
  write_vdb(folder / "a.vdb", numbered_fluid(), 1.25);
  openvdb::io::File file((folder / "a.vdb").string());
  file.open();
  EXPECT_EQ(file.getMetadata()->metaValue<double>("time_s"), 1.25);
  const auto density = openvdb::gridPtrCast<openvdb::FloatGrid>(file.readGrid("density"));
  const auto velocity = openvdb::gridPtrCast<openvdb::Vec3SGrid>(file.readGrid("velocity"));
  EXPECT_EQ(density->background(), 0);
  EXPECT_EQ(density->activeVoxelCount(), 2U * 341);
  EXPECT_EQ(velocity->activeVoxelCount(), 2U * 341);
  EXPECT_EQ(velocity->metaValue<std::string>("unit"), "m/s");
  const openvdb::Coord cell(16 + 1, 8 + 2, 3);  // number 64 + 16 + 3 = 83 of the second block
  EXPECT_EQ(density->tree().getValue(cell), 83.0F / 512);
  EXPECT_EQ(velocity->tree().getValue(cell), openvdb::Vec3s(83, -83, 16));
  EXPECT_FALSE(density->tree().isValueOn(openvdb::Coord(-8, 0, 8)));
  EXPECT_TRUE(density->tree().isValueOn(openvdb::Coord(-8, 0, 9)));
  EXPECT_EQ(density->indexToWorld(openvdb::Coord(0, 0, 0)), openvdb::Vec3d(10.125, 20.125, 30.125));
  EXPECT_EQ(velocity->indexToWorld(openvdb::Coord(4, 0, -4)), openvdb::Vec3d(11.125, 20.125, 29.125));
}

TEST(VdbWriter, NumbersItsFiles) {
  const TestFolder folder;
  VdbWriter writer(folder.path());
  (void)writer.write(0, numbered_fluid());
  EXPECT_EQ(writer.write(1, {0.25, Vec3::Zero(), {}}), folder / "fluid_000001.vdb") << "a dry scene must work too";
  EXPECT_TRUE(std::filesystem::exists(folder / "fluid_000000.vdb"));
  openvdb::io::File file((folder / "fluid_000001.vdb").string());
  EXPECT_TRUE(file.open());
}

TEST(VdbWriter, RefusesBlocksOffTheGrid) {
  const TestFolder folder;
  lbm::FluidSnapshot fluid = numbered_fluid();
  fluid.blocks[0].origin.x() = 3;
  EXPECT_THROW(write_vdb(folder / "a.vdb", fluid, 0), std::logic_error);
  EXPECT_THROW(write_vdb(folder / "a.vdb", {}, 0), std::logic_error) << "no cell size";
}

TEST(VdbWriter, AFullDiskLeavesNoBrokenFile) {
  const TestFolder folder;
  std::fflush(nullptr);
  const pid_t child = fork();  // before anything has started threads: the child would wait for them for ever
  if (child == 0) {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{3000, 3000};
    setrlimit(RLIMIT_FSIZE, &limit);
    try {
      write_vdb(folder / "a.vdb", numbered_fluid(), 0);
    } catch (const FileError&) {
      _exit(7);
    }
    _exit(1);
  }
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_EQ(WEXITSTATUS(status), 7);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
  EXPECT_THROW(write_vdb(folder / "missing/a.vdb", numbered_fluid(), 0), FileError);
}

}  // namespace
}  // namespace lahar::cases
