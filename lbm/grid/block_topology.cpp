#include "lbm/grid/block_topology.h"

#include <openvdb/openvdb.h>

#include <algorithm>
#include <cstddef>
#include <utility>

#include "core/check.h"
#include "lbm/grid/morton.h"

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

BlockIndex BlockTopology::take_index() {
  if (free_.empty()) {
    coordinates_.emplace_back();
    keys_.emplace_back();
    neighbours_.emplace_back();
    return static_cast<BlockIndex>(coordinates_.size() - 1);
  }
  const BlockIndex b = free_.back();
  free_.pop_back();
  return b;
}

/// Where a block stands in the list, or would.
std::vector<BlockIndex>::iterator BlockTopology::place_of(BlockIndex b) {
  const auto key = [&](BlockIndex k) { return keys_[static_cast<std::size_t>(k)]; };
  return std::lower_bound(active_.begin(), active_.end(), b, [&](auto k, auto l) { return key(k) < key(l); });
}

BlockIndex BlockTopology::insert(const Vec3i& block) {
  require(find(block) == kNoBlock, "BlockTopology::insert: the block exists already");
  const BlockIndex b = take_index();
  enter(wrapped(block), b);
  active_.insert(place_of(b), b);
  return b;
}

std::vector<BlockIndex> BlockTopology::insert_missing(const std::vector<Vec3i>& blocks) {
  std::vector<std::pair<std::uint64_t, Vec3i>> missing;
  for (const Vec3i& block : blocks)
    if (find(block) == kNoBlock) missing.emplace_back(morton_key(wrapped(block)), wrapped(block));
  std::sort(missing.begin(), missing.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  missing.erase(
      std::unique(missing.begin(), missing.end(), [](const auto& a, const auto& b) { return a.first == b.first; }),
      missing.end());
  std::vector<BlockIndex> inserted;
  for (const auto& [key, block] : missing) {
    inserted.push_back(take_index());
    enter(block, inserted.back());
  }
  const auto middle = static_cast<std::ptrdiff_t>(active_.size());
  active_.insert(active_.end(), inserted.begin(), inserted.end());
  std::inplace_merge(active_.begin(), active_.begin() + middle, active_.end(), [&](BlockIndex a, BlockIndex b) {
    return keys_[static_cast<std::size_t>(a)] < keys_[static_cast<std::size_t>(b)];
  });
  return inserted;
}

/// Puts a block that has its index into the tree and its neighbours' tables.
void BlockTopology::enter(const Vec3i& block, BlockIndex b) {
  tree_->accessor.setValue(coord(block), b);
  coordinates_[static_cast<std::size_t>(b)] = block;
  keys_[static_cast<std::size_t>(b)] = morton_key(block);
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
  active_.erase(place_of(b));
  free_.insert(std::lower_bound(free_.begin(), free_.end(), b, std::greater<>()), b);
}

void BlockTopology::transfer(Archive& archive) {
  require(!archive.loading() || active_.empty(), "BlockTopology::transfer: loads into an empty topology only");
  std::size_t largest = capacity();
  std::vector<BlockIndex> indices = active_;
  archive.value("capacity", largest);
  archive.list("indices", indices);
  std::vector<std::uint8_t> used;
  if (archive.loading()) {
    if (largest > 0x7fffffff) archive.refuse("capacity", "is no number of blocks");
    used.assign(largest, 0);
    for (const BlockIndex b : indices) {
      const auto at = static_cast<std::size_t>(b);
      if (b < 0 || at >= used.size() || used[at]) archive.refuse("indices", "are no indices of blocks");
      used[at] = 1;
    }
    coordinates_.assign(largest, Vec3i::Zero());
    keys_.assign(largest, 0);
    neighbours_.assign(largest, {});
  }
  archive.pieces<std::int32_t>("coordinates", indices.size(), 3, [&](std::size_t k, std::int32_t* at) {
    if (!archive.loading()) return std::copy_n(coordinate(indices[k]).data(), 3, at), void();
    const Vec3i block(at[0], at[1], at[2]);
    if (find(block) != kNoBlock) archive.refuse("coordinates", "name a block twice");
    if (k > 0 && morton_key(block) <= keys_[static_cast<std::size_t>(indices[k - 1])])
      archive.refuse("coordinates", "are not in Morton order");
    enter(block, indices[k]);
  });
  if (!archive.loading()) return;
  active_ = indices;
  free_.clear();
  for (std::size_t b = largest; b-- > 0;)
    if (!used[b]) free_.push_back(static_cast<BlockIndex>(b));
}

}  // namespace lahar::lbm
