#pragma once
// Which blocks exist and who neighbours whom. The map from block coordinate to block index is an OpenVDB tree, so the
// index of a block anywhere in space is found in constant time and memory follows the blocks that exist. An index is a
// handle to storage that is used again; what hangs on an order goes by the Morton order of the coordinates (morton.h).
#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/archive.h"
#include "lbm/grid/cells.h"

namespace lahar::lbm {

class BlockTopology {
 public:
  /// `period`: number of blocks after which an axis repeats, 0 for none.
  explicit BlockTopology(const Vec3i& period = Vec3i::Zero());
  ~BlockTopology();
  BlockTopology(const BlockTopology&) = delete;
  BlockTopology& operator=(const BlockTopology&) = delete;

  /// Index of the block at a block coordinate, or kNoBlock. Safe to call from several threads.
  [[nodiscard]] BlockIndex find(const Vec3i& block) const;
  /// Creates a block (which must not exist) and links it with its neighbours. Freed indices are used again.
  BlockIndex insert(const Vec3i& block);
  /// The same for those of the blocks that do not exist; returns them in Morton order. One pass over the list.
  std::vector<BlockIndex> insert_missing(const std::vector<Vec3i>& blocks);
  void erase(BlockIndex b);
  /// State of a checkpoint; loading needs an empty topology. Blocks keep their indices, which others hold as handles.
  void transfer(Archive& archive);

  [[nodiscard]] const Vec3i& coordinate(BlockIndex b) const { return coordinates_[static_cast<std::size_t>(b)]; }
  /// Neighbours by slot (see neighbour_slot); kNoBlock where there is none.
  [[nodiscard]] const std::array<BlockIndex, 27>& neighbours(BlockIndex b) const {
    return neighbours_[static_cast<std::size_t>(b)];
  }
  /// Existing blocks in Morton order.
  [[nodiscard]] const std::vector<BlockIndex>& active() const { return active_; }
  /// Largest index ever used + 1.
  [[nodiscard]] std::size_t capacity() const { return coordinates_.size(); }

 private:
  [[nodiscard]] Vec3i wrapped(Vec3i block) const;
  BlockIndex take_index();
  void enter(const Vec3i& block, BlockIndex b);
  [[nodiscard]] std::vector<BlockIndex>::iterator place_of(BlockIndex b);

  struct Tree;
  Vec3i period_;
  std::unique_ptr<Tree> tree_;
  std::vector<Vec3i> coordinates_;
  std::vector<std::uint64_t> keys_;  // Morton keys of the coordinates
  std::vector<std::array<BlockIndex, 27>> neighbours_;
  std::vector<BlockIndex> active_, free_;
};

}  // namespace lahar::lbm
