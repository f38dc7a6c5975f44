#include "cases/files/vdb_writer.h"

#include <fmt/format.h>
#include <openvdb/openvdb.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>

#include "cases/files/output_file.h"
#include "core/check.h"

namespace lahar::cases {

namespace {

using Block = lbm::FluidSnapshot::Block;

// A snapshot's block has the layout of an OpenVDB leaf (z fastest), so values are copied straight into its buffer.
static_assert(openvdb::FloatTree::LeafNodeType::DIM == lbm::FluidSnapshot::block_width);

openvdb::Coord leaf_origin(const Block& block) {
  for (int d = 0; d < 3; ++d)
    require(block.origin[d] % lbm::FluidSnapshot::block_width == 0, "write_vdb: block origin is not a leaf origin");
  return {block.origin.x(), block.origin.y(), block.origin.z()};
}

template <class Leaf>
void activate_wet_voxels(Leaf& leaf, const Block& block) {
  for (openvdb::Index n = 0; n < Leaf::SIZE; ++n) leaf.setActiveState(n, block.fill_level[n] != 0);
}

openvdb::FloatGrid::Ptr density_grid(const lbm::FluidSnapshot& fluid) {
  auto grid = openvdb::FloatGrid::create(0.0F);
  for (const Block& block : fluid.blocks) {
    auto* leaf = grid->tree().touchLeaf(leaf_origin(block));
    std::copy(block.fill_level.begin(), block.fill_level.end(), leaf->buffer().data());
    activate_wet_voxels(*leaf, block);
  }
  grid->setName("density");
  grid->setGridClass(openvdb::GRID_FOG_VOLUME);
  grid->insertMeta("unit", openvdb::StringMetadata("1"));
  return grid;
}

openvdb::Vec3SGrid::Ptr velocity_grid(const lbm::FluidSnapshot& fluid) {
  auto grid = openvdb::Vec3SGrid::create(openvdb::Vec3s(0.0F));
  for (const Block& block : fluid.blocks) {
    auto* leaf = grid->tree().touchLeaf(leaf_origin(block));
    openvdb::Vec3s* values = leaf->buffer().data();
    for (std::size_t n = 0; n < block.fill_level.size(); ++n)
      values[n] = {block.velocity_x[n], block.velocity_y[n], block.velocity_z[n]};
    activate_wet_voxels(*leaf, block);
  }
  grid->setName("velocity");
  grid->setVectorType(openvdb::VEC_CONTRAVARIANT_RELATIVE);
  grid->insertMeta("unit", openvdb::StringMetadata("m/s"));
  return grid;
}

openvdb::math::Transform::Ptr cell_centres(const lbm::FluidSnapshot& fluid) {
  auto transform = openvdb::math::Transform::createLinearTransform(fluid.cell_size);
  const Vec3 first = fluid.origin + Vec3::Constant(0.5 * fluid.cell_size);
  transform->postTranslate({first.x(), first.y(), first.z()});
  return transform;
}

// openvdb::io::File does not notice a full disk, and openvdb::io::Stream leaves out the offsets by which readers find a
// single grid. The archive below them writes with offsets into a stream whose state we can ask.
struct SeekableArchive : openvdb::io::Archive {
  using Archive::write;
};

void write_file(const std::filesystem::path& part, const std::filesystem::path& path, const openvdb::GridPtrVec& grids,
                const openvdb::MetaMap& meta) {
  errno = 0;
  std::ofstream out(part, std::ios::binary);
  if (!out) throw FileError(path, std::string("cannot be created: ") + std::strerror(errno));
  SeekableArchive archive;
  archive.setCompression(openvdb::io::COMPRESS_BLOSC | openvdb::io::COMPRESS_ACTIVE_MASK);
  errno = 0;
  archive.write(out, grids, true, meta);
  out.close();
  if (!out) throw FileError(path, std::string("cannot be written: ") + std::strerror(errno));
}

}  // namespace

void write_vdb(const std::filesystem::path& path, const lbm::FluidSnapshot& fluid, double time_s) {
  require(fluid.cell_size > 0, "write_vdb: the snapshot has no cell size");
  openvdb::initialize();
  const openvdb::FloatGrid::Ptr density = density_grid(fluid);
  const openvdb::Vec3SGrid::Ptr velocity = velocity_grid(fluid);
  density->setTransform(cell_centres(fluid));
  velocity->setTransform(density->transformPtr());
  openvdb::MetaMap meta;
  meta.insertMeta("time_s", openvdb::DoubleMetadata(time_s));
  meta.insertMeta("cell_size_m", openvdb::DoubleMetadata(fluid.cell_size));
  replace_file(path, [&](const std::filesystem::path& part) { write_file(part, path, {density, velocity}, meta); });
}

std::filesystem::path VdbWriter::write(double time_s, const lbm::FluidSnapshot& fluid) {
  const std::filesystem::path path = directory_ / fmt::format("fluid_{:06}.vdb", frames_);
  write_vdb(path, fluid, time_s);
  ++frames_;
  return path;
}

}  // namespace lahar::cases
