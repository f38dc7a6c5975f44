#include "dem/bonds/bond_layout.h"

#include <algorithm>
#include <bit>

#include "core/check.h"

namespace lahar::dem {

BondLayout::BondLayout(const Bonds& bonds, std::size_t particles) {
  cut_into_chunks(bonds, particles);
  cut_into_tiles(bonds);
  colour_chunks(bonds, particles);
}

/// Cuts the bonds into chunks, where possible between bonds that share no particle (between two rings).
void BondLayout::cut_into_chunks(const Bonds& bonds, std::size_t particles) {
  std::vector<std::size_t> last_bond(particles, 0);
  for (std::size_t b = 0; b < bonds.size(); ++b) last_bond[bonds.i[b]] = last_bond[bonds.j[b]] = b;
  chunks.clear();
  std::size_t first = 0, clean_cut = 0, reach = 0;
  for (std::size_t b = 0; b < bonds.size(); ++b) {
    if (reach < b) clean_cut = b;  // nothing before b shares a particle with b or later
    if (b - first == kChunk) {
      const std::size_t cut = clean_cut > first ? clean_cut : b;
      chunks.push_back({static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(cut), 0, 0});
      first = cut;
    }
    reach = std::max({reach, last_bond[bonds.i[b]], last_bond[bonds.j[b]]});
  }
  if (first < bonds.size())
    chunks.push_back({static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(bonds.size()), 0, 0});
}

void BondLayout::cut_into_tiles(const Bonds& bonds) {
  links.clear();
  tiles.clear();
  for (Chunk& chunk : chunks) {
    chunk.first_tile = static_cast<std::uint32_t>(tiles.size());
    for (std::uint32_t b = chunk.first; b < chunk.last; ++b) {
      const bool new_tile = b == chunk.first || bonds.sort[b] != bonds.sort[b - 1] || b - tiles.back().first == kTile;
      const bool new_link =
          new_tile || bonds.id_i[b] != bonds.id_i[b - 1] + 1 || bonds.id_j[b] != bonds.id_j[b - 1] + 1;
      const auto link = static_cast<std::uint32_t>(links.size());
      if (new_tile) tiles.push_back({b, b, link, link, bonds.sort[b]});
      if (new_link) links.push_back({b, b, bonds.i[b], bonds.j[b], bonds.id_j[b] == bonds.id_i[b] + 1, true});
      links.back().last = tiles.back().last = b + 1;
      tiles.back().last_link = static_cast<std::uint32_t>(links.size());
    }
    chunk.last_tile = static_cast<std::uint32_t>(tiles.size());
  }
  find_ends(bonds);
}

void BondLayout::find_ends(const Bonds& bonds) {
  for (Link& link : links) {
    link.i = bonds.i[link.first], link.j = bonds.j[link.first];
    link.in_line = !link.chain || link.j == link.i + 1;
    for (std::uint32_t b = link.first; b < link.last; ++b)
      link.in_line = link.in_line && bonds.i[b] == link.i + (b - link.first) && bonds.j[b] == link.j + (b - link.first);
  }
}

/// Gives each chunk the first colour that no earlier chunk with a common particle has.
void BondLayout::colour_chunks(const Bonds& bonds, std::size_t particles) {
  std::vector<std::uint64_t> taken(particles, 0);  // bit per colour
  colours.clear();
  for (std::uint32_t c = 0; c < chunks.size(); ++c) {
    std::uint64_t near = 0;
    for (std::size_t b = chunks[c].first; b < chunks[c].last; ++b) near |= taken[bonds.i[b]] | taken[bonds.j[b]];
    require(~near != 0, "too many chunks of bonds meet at one particle");
    const auto colour = static_cast<std::size_t>(std::countr_one(near));
    if (colour == colours.size()) colours.emplace_back();
    colours[colour].push_back(c);
    for (std::size_t b = chunks[c].first; b < chunks[c].last; ++b)
      for (const ParticleIndex p : {bonds.i[b], bonds.j[b]}) taken[p] |= std::uint64_t{1} << colour;
  }
}

}  // namespace lahar::dem
