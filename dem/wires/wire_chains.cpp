#include "dem/wires/wire_chains.h"

#include <algorithm>
#include <utility>

namespace lahar::dem {

namespace {

bool joins_wire(const Bonds& bonds, const Particles& p, std::size_t b) {
  const ParticleIndex i = bonds.i[b], j = bonds.j[b];
  return p.kind[i] == ParticleKind::bead && p.kind[j] == ParticleKind::bead && p.body[i] == p.body[j] &&
         p.body[i] >= 0 && p.radius[i] == p.radius[j];
}

/// Per particle: whether it belongs to a body in which a bead has three wire bonds or more.
std::vector<std::uint8_t> in_mesh(const Bonds& bonds, const Particles& p) {
  std::vector<std::uint8_t> count(p.size(), 0), mesh(p.size(), 0);
  for (std::size_t b = 0; b < bonds.size(); ++b)
    if (joins_wire(bonds, p, b))
      for (const ParticleIndex i : {bonds.i[b], bonds.j[b]})
        count[i] = static_cast<std::uint8_t>(std::min(3, count[i] + 1));
  std::vector<std::int32_t> bodies;
  for (std::size_t i = 0; i < p.size(); ++i)
    if (count[i] > 2) bodies.push_back(p.body[i]);
  std::sort(bodies.begin(), bodies.end());
  for (std::size_t i = 0; i < p.size(); ++i)
    mesh[i] = std::binary_search(bodies.begin(), bodies.end(), p.body[i]) ? 1 : 0;
  return mesh;
}

}  // namespace

void WireChains::build(const Bonds& bonds, const Particles& p) {
  const std::size_t n = p.size();
  covered_.assign(n, 0);
  closed_.assign(n, 0);
  before_.assign(n, none);  // for now the two neighbours in any order
  behind_.assign(n, none);
  const auto mesh = in_mesh(bonds, p);
  const auto join = [&](ParticleIndex i, ParticleIndex j) { (before_[i] == none ? before_ : behind_)[i] = j; };
  for (std::size_t b = 0; b < bonds.size(); ++b) {
    const ParticleIndex i = bonds.i[b], j = bonds.j[b];
    if (bonds.intact[b] == 0 || !joins_wire(bonds, p, b) || mesh[i] != 0) continue;
    join(i, j), join(j, i);
    covered_[i] = covered_[j] = 1;
  }
  std::vector<std::uint8_t> ordered(n, 0);
  const auto order_all = [&](bool closed) {  // open chains from their lower end first, then closed ones
    for (ParticleId id = 0; id < n; ++id) {
      const ParticleIndex i = p.index(id);
      if (covered_[i] == 0 || ordered[i] != 0 || (!closed && !is_end(i))) continue;
      order_chain(i, p.numbering);
      for (ParticleIndex k = i; k != none && ordered[k] == 0; k = behind_[k])
        ordered[k] = 1, closed_[k] = closed ? 1 : 0;
    }
  };
  order_all(false);
  order_all(true);
  find_near(bonds, n);
}

/// Sorts the neighbours of all beads of a chain into before and behind, starting here; a ring towards its lower one.
void WireChains::order_chain(ParticleIndex from, const Numbering& numbering) {
  if (before_[from] != none && (behind_[from] == none || numbering.precedes(before_[from], behind_[from])))
    std::swap(before_[from], behind_[from]);
  for (ParticleIndex last = from, k = behind_[from]; k != none && k != from; last = std::exchange(k, behind_[k]))
    if (before_[k] != last) std::swap(before_[k], behind_[k]);
}

void WireChains::find_near(const Bonds& bonds, std::size_t n) {
  std::vector<std::vector<ParticleIndex>> joined(n);
  for (std::size_t b = 0; b < bonds.size(); ++b) {
    if (bonds.intact[b] == 0) continue;  // stumps of a broken wire touch
    joined[bonds.i[b]].push_back(bonds.j[b]);
    joined[bonds.j[b]].push_back(bonds.i[b]);
  }
  near_offset_.assign(1, 0);
  near_.clear();
  for (std::size_t i = 0; i < n; ++i) {
    const auto row = static_cast<std::ptrdiff_t>(near_.size());
    for (const ParticleIndex j : joined[i]) {
      near_.push_back(j);
      near_.insert(near_.end(), joined[j].begin(), joined[j].end());
    }
    std::sort(near_.begin() + row, near_.end());
    near_.erase(std::unique(near_.begin() + row, near_.end()), near_.end());
    near_offset_.push_back(static_cast<std::uint32_t>(near_.size()));
  }
}

void WireChains::renumber(const Renumbering& change) {
  change.move(covered_);
  change.move(closed_);
  for (std::vector<ParticleIndex>* beads : {&before_, &behind_}) {
    for (ParticleIndex& i : *beads)
      if (i != none) i = change.to(i);
    change.move(*beads, none);
  }
  reorder(near_, change.move_rows(near_offset_));
  for (ParticleIndex& j : near_) j = change.to(j);
  for (std::size_t i = 0; i + 1 < near_offset_.size(); ++i)
    std::sort(near_.begin() + near_offset_[i], near_.begin() + near_offset_[i + 1]);
}

bool WireChains::near(ParticleIndex i, ParticleIndex j) const {
  return i == j || std::binary_search(near_.begin() + near_offset_[i], near_.begin() + near_offset_[i + 1], j);
}

}  // namespace lahar::dem
