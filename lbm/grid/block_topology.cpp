#include "lbm/grid/block_topology.h"

#include <openvdb/openvdb.h>

#include <algorithm>

#include "core/check.h"

namespace lahar::lbm {

struct BlockTopology::Tree {
  openvdb::Int32Tree tree{kNoBlock};
  openvdb::tree::ValueAccessor<openvdb::Int32Tree> accessor{tree};
};

namespace {

openvdb::Coord coord(const Vec3i& v) { return {v.x(), v.y(), v.z()}; }

}  // namespace

BlockTopology::BlockTopology(const Vec3i& period) : period_(period), tree_(std::make_unique<Tree>()) {}
BlockTopology::~BlockTopology() = default;

Vec3i BlockTopology::wrapped(Vec3i block) const {
  for (int axis = 0; axis < 3; ++axis)
    if (period_[axis] > 0) block[axis] = ((block[axis] % period_[axis]) + period_[axis]) % period_[axis];
  return block;
}

/// Past the accessor: its cache makes reading from several threads a race.
BlockIndex BlockTopology::find(const Vec3i& block) const { return tree_->tree.getValue(coord(wrapped(block))); }

BlockIndex BlockTopology::insert(const Vec3i& place) {
  const Vec3i block = wrapped(place);
  require(find(block) == kNoBlock, "BlockTopology::insert: the block exists already");
  BlockIndex b;
  if (free_.empty()) {
    b = static_cast<BlockIndex>(coordinates_.size());
    coordinates_.push_back(block);
    neighbours_.emplace_back();
  } else {
    b = free_.back();
    free_.pop_back();
    coordinates_[static_cast<std::size_t>(b)] = block;
  }
  enter(block, b);
  return b;
}

/// Puts a block that has its index into the tree, the list and its neighbours' tables.
void BlockTopology::enter(const Vec3i& block, BlockIndex b) {
  tree_->accessor.setValue(coord(block), b);
  active_.insert(std::lower_bound(active_.begin(), active_.end(), b), b);
  auto& mine = neighbours_[static_cast<std::size_t>(b)];
  for (int dx = -1; dx <= 1; ++dx)
    for (int dy = -1; dy <= 1; ++dy)
      for (int dz = -1; dz <= 1; ++dz) {
        const BlockIndex other = find(block + Vec3i(dx, dy, dz));
        mine[static_cast<std::size_t>(neighbour_slot(dx, dy, dz))] = other;
        if (other != kNoBlock)
          neighbours_[static_cast<std::size_t>(other)][static_cast<std::size_t>(neighbour_slot(-dx, -dy, -dz))] = b;
      }
}

void BlockTopology::erase(BlockIndex b) {
  const auto& mine = neighbours_[static_cast<std::size_t>(b)];
  for (int slot = 0; slot < 27; ++slot) {
    const BlockIndex other = mine[static_cast<std::size_t>(slot)];
    if (other != kNoBlock && other != b)
      neighbours_[static_cast<std::size_t>(other)][static_cast<std::size_t>(26 - slot)] = kNoBlock;
  }
  tree_->accessor.setValueOff(coord(coordinate(b)), kNoBlock);
  active_.erase(std::lower_bound(active_.begin(), active_.end(), b));
  free_.insert(std::lower_bound(free_.begin(), free_.end(), b, std::greater<>()), b);
}

void BlockTopology::transfer(Archive& archive) {
  require(!archive.loading() || active_.empty(), "BlockTopology::transfer: loads into an empty topology only");
  std::size_t largest = capacity();
  std::vector<BlockIndex> indices = active_;
  archive.value("capacity", largest);
  archive.list("indices", indices);
  if (archive.loading()) {
    const bool ascending = std::adjacent_find(indices.begin(), indices.end(), std::greater_equal<>()) == indices.end();
    if (!ascending || largest > 0x7fffffff ||
        (!indices.empty() && (indices.front() < 0 || static_cast<std::size_t>(indices.back()) >= largest)))
      archive.refuse("indices", "are no indices of blocks");
    coordinates_.assign(largest, Vec3i::Zero());
    neighbours_.assign(largest, {});
  }
  archive.pieces<std::int32_t>("coordinates", indices.size(), 3, [&](std::size_t k, std::int32_t* at) {
    if (!archive.loading()) return std::copy_n(coordinate(indices[k]).data(), 3, at), void();
    const Vec3i block(at[0], at[1], at[2]);
    if (find(block) != kNoBlock) archive.refuse("coordinates", "name a block twice");
    coordinates_[static_cast<std::size_t>(indices[k])] = block;
    enter(block, indices[k]);
  });
  if (!archive.loading()) return;
  free_.clear();
  for (auto b = static_cast<BlockIndex>(largest); b-- > 0;)
    if (!std::binary_search(indices.begin(), indices.end(), b)) free_.push_back(b);
}

}  // namespace lahar::lbm
