#include "dem/numbering.h"

#include <limits>
#include <utility>

#include "core/check.h"

namespace lahar::dem {

Renumbering::Renumbering(std::vector<ParticleIndex> order) : from_(std::move(order)) {
  constexpr ParticleIndex nowhere = std::numeric_limits<ParticleIndex>::max();
  to_.assign(size(), nowhere);
  for (ParticleIndex k = 0; k < size(); ++k) {
    require(from_[k] < size() && to_[from_[k]] == nowhere, "an order of particles must hold each of them once");
    to_[from_[k]] = k;
  }
}

std::vector<std::uint32_t> Renumbering::move_rows(std::vector<std::uint32_t>& offset) const {
  std::vector<std::uint32_t> entries;
  if (offset.empty()) return entries;
  entries.reserve(offset.back());
  std::vector<std::uint32_t> moved(1, 0);
  for (const ParticleIndex row : from_) {
    if (row + 1 < offset.size())
      for (std::uint32_t k = offset[row]; k < offset[row + 1]; ++k) entries.push_back(k);
    moved.push_back(static_cast<std::uint32_t>(entries.size()));
  }
  offset.swap(moved);
  return entries;
}

void Numbering::apply(const Renumbering& change) {
  std::vector<ParticleId> ids(change.size());
  bool same = true;
  for (ParticleIndex i = 0; i < change.size(); ++i) {
    ids[i] = id(change.from(i));
    same = same && ids[i] == i;
  }
  id_.clear();
  index_.clear();
  if (same) return;
  id_ = std::move(ids);
  index_.resize(id_.size());
  for (ParticleIndex i = 0; i < id_.size(); ++i) index_[id_[i]] = i;
}

Renumbering Numbering::to_ids(std::size_t size) const {
  std::vector<ParticleIndex> order(size);
  for (std::size_t k = 0; k < size; ++k) order[k] = index(k);
  return Renumbering(std::move(order));
}

}  // namespace lahar::dem
