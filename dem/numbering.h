#pragma once
// Names and places of particles. A particle's id never changes: bonds, bodies, contact histories, checkpoints and files
// refer to it, and sums run in the order of ids. Its index is where it stands in the arrays now.
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/vector.h"

namespace lahar::dem {

/// Name of a particle: the number of particles that were added before it. Never used again.
using ParticleId = std::uint32_t;
/// Place of a particle in the arrays of now: its id, until particles are renumbered.
using ParticleIndex = std::uint32_t;

/// A change of places: what stands at order[k] goes to k.
class Renumbering {
 public:
  /// Throws std::logic_error unless `order` holds every index below its size once.
  explicit Renumbering(std::vector<ParticleIndex> order);

  [[nodiscard]] std::size_t size() const { return from_.size(); }
  /// Where stood what now stands at i.
  [[nodiscard]] ParticleIndex from(std::size_t i) const { return from_[i]; }
  /// Where now stands what stood at i.
  [[nodiscard]] ParticleIndex to(std::size_t i) const { return to_[i]; }
  /// The change that undoes this one.
  [[nodiscard]] Renumbering inverse() const { return Renumbering(to_); }

  /// Moves numbers that are there per particle. An empty list stays empty; particles beyond the end of a list, added
  /// after it was made, get `missing`.
  template <class T>
  void move(std::vector<T>& values, const T& missing = {}) const {
    if (values.empty()) return;
    std::vector<T> moved(size(), missing);
    for (std::size_t i = 0; i < size(); ++i)
      if (from_[i] < values.size()) moved[i] = values[from_[i]];
    values.swap(moved);
  }
  void move(Vec3Field& field) const { move(field.x), move(field.y), move(field.z); }

  /// Moves the rows of a list in compressed form, of which row i is [offset[i], offset[i + 1]). Returns for each entry
  /// where it was. Rows that are missing are empty.
  [[nodiscard]] std::vector<std::uint32_t> move_rows(std::vector<std::uint32_t>& offset) const;

 private:
  std::vector<ParticleIndex> from_, to_;
};

/// values[k] = values[from[k]]; an empty list stays empty.
template <class T>
void reorder(std::vector<T>& values, const std::vector<std::uint32_t>& from) {
  if (values.empty()) return;
  std::vector<T> moved(from.size());
  for (std::size_t k = 0; k < from.size(); ++k) moved[k] = values[from[k]];
  values.swap(moved);
}

/// Which particle stands where. Takes no memory while every index is the id.
class Numbering {
 public:
  /// True while every particle's index is its id.
  [[nodiscard]] bool by_id() const { return id_.empty(); }
  [[nodiscard]] ParticleId id(std::size_t index) const {
    return id_.empty() ? static_cast<ParticleId>(index) : id_[index];
  }
  [[nodiscard]] ParticleIndex index(std::size_t id) const {
    return index_.empty() ? static_cast<ParticleIndex>(id) : index_[id];
  }
  /// Whether the particle at index a has the lower id.
  [[nodiscard]] bool precedes(std::size_t a, std::size_t b) const { return id(a) < id(b); }

  /// A particle was added at the end.
  void add() {
    if (id_.empty()) return;
    id_.push_back(static_cast<ParticleId>(id_.size()));
    index_.push_back(static_cast<ParticleIndex>(index_.size()));
  }
  void apply(const Renumbering& change);
  /// The change that gives each of `size` particles the index that is its id.
  [[nodiscard]] Renumbering to_ids(std::size_t size) const;

 private:
  std::vector<ParticleId> id_;        // by index; empty while by_id
  std::vector<ParticleIndex> index_;  // by id
};

}  // namespace lahar::dem
