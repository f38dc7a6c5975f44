#pragma once
// How bonds are cut up for the loop over them: into chunks for threads, tiles for the cache and links of consecutive
// ends.
#include <cstddef>
#include <cstdint>
#include <vector>

#include "dem/bonds/bonds.h"

namespace lahar::dem {

struct BondLayout {
  static constexpr std::size_t kChunk = 1024;  ///< bonds of a chunk, at most; fixes the order of sums
  static constexpr std::size_t kTile = 128;    ///< bonds whose intermediate results stay in the first-level cache

  /// Consecutive bonds of one sort whose ends have consecutive ids too, as beads have along their ring or cable. Nearly
  /// all bonds lie in long links. Where the ends also stand next to each other in the arrays, which is so unless
  /// particles were renumbered, bond first + k joins what stands at i + k and j + k, and needs no indices.
  struct Link {
    std::uint32_t first, last;
    ParticleIndex i, j;  ///< of the first bond
    bool chain;          ///< the second end of a bond is the first one of the next
    bool in_line;        ///< the ends stand next to each other
  };
  /// Links of one sort, few enough bonds for the first-level cache.
  struct Tile {
    std::uint32_t first, last;            ///< bonds
    std::uint32_t first_link, last_link;  ///< of `links`
    std::int32_t sort;
  };
  /// What one thread does at a time: all tiles of a stretch of bonds, adding to its particles as it goes. Chunks of one
  /// colour have no particle in common.
  struct Chunk {
    std::uint32_t first, last;            ///< bonds
    std::uint32_t first_tile, last_tile;  ///< of `tiles`
  };

  std::vector<Link> links;
  std::vector<Tile> tiles;
  std::vector<Chunk> chunks;
  std::vector<std::vector<std::uint32_t>> colours;  ///< chunks of each colour

  BondLayout() = default;
  BondLayout(const Bonds& bonds, std::size_t particles);
  /// The particles were renumbered, and the bonds know where their ends stand.
  void find_ends(const Bonds& bonds);

 private:
  void cut_into_chunks(const Bonds& bonds, std::size_t particles);
  void cut_into_tiles(const Bonds& bonds);
  void colour_chunks(const Bonds& bonds, std::size_t particles);
};

}  // namespace lahar::dem
