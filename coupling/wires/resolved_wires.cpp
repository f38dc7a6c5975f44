#include "coupling/wires/resolved_wires.h"

namespace lahar::coupling {

namespace {

constexpr double kSamePlace = 1e-6;  ///< of the diameter

bool is_whole(const dem::Particles& particles, const dem::Bonds& bonds, std::size_t k) {
  return bonds.intact[k] && particles.state[bonds.i[k]] != dem::ParticleState::removed &&
         particles.state[bonds.j[k]] != dem::ParticleState::removed;
}

/// Out of a piece, at one of its ends.
Vec3 outward(const dem::Particles& particles, const dem::Bonds& bonds, std::uint32_t bond, int end) {
  const Vec3 along = particles.position[bonds.j[bond]] - particles.position[bonds.i[bond]];
  return (end == 0 ? -along : along).normalized();
}

/// Two ends that meet; `one` and `other` point out of their pieces.
void join(const Vec3& one, const Vec3& other, WireEnd& first, WireEnd& second) {
  if (one.dot(other) > 0) return;  // bent by more than a right angle
  const Vec3 normal = (one - other).normalized();
  first = {normal, -1};
  second = {normal, 1};
}

/// Whether two places are whole periods apart, and not the same.
bool goes_on(const Vec3& a, const Vec3& b, const Vec3& period, double tolerance) {
  Vec3 apart = a - b;
  bool shifted = false;
  for (int k = 0; k < 3; ++k) {
    if (period[k] <= 0) continue;
    const double turns = std::round(apart[k] / period[k]);
    apart[k] -= turns * period[k];
    shifted = shifted || turns != 0;
  }
  return shifted && apart.norm() < tolerance;
}

}  // namespace

ResolvedWires::ResolvedWires(const dem::Particles& particles, const dem::Bonds& bonds, double smallest_diameter)
    : thick_(bonds.size(), 0), mapped_(bonds.size(), 0), id_i_(bonds.id_i), id_j_(bonds.id_j) {
  for (std::size_t k = 0; k < bonds.size(); ++k)
    thick_[k] = is_wire(particles, bonds, k) && wire_diameter(particles, bonds, k) >= smallest_diameter;
  update(particles, bonds);
}

bool ResolvedWires::update(const dem::Particles& particles, const dem::Bonds& bonds) {
  bool changed = false;
  for (std::size_t k = 0; k < thick_.size(); ++k) {
    const std::uint8_t now = thick_[k] && is_whole(particles, bonds, k);
    changed = changed || now != mapped_[k];
    mapped_[k] = now;
  }
  if (changed) find_pieces();
  return changed;
}

void ResolvedWires::transfer(Archive& archive) {
  archive.list_of("mapped", mapped_, thick_.size());
  if (archive.loading()) find_pieces();
}

void ResolvedWires::find_pieces() {
  pieces_.clear(), first_.clear(), second_.clear();
  for (std::size_t k = 0; k < mapped_.size(); ++k)
    if (mapped_[k]) {
      pieces_.push_back(static_cast<std::uint32_t>(k));
      first_.push_back(id_i_[k]), second_.push_back(id_j_[k]);
    }
  link();
}

/// The beads of the pieces, and which ends meet there.
void ResolvedWires::link() {
  beads_ = first_;
  beads_.insert(beads_.end(), second_.begin(), second_.end());
  std::sort(beads_.begin(), beads_.end());
  beads_.erase(std::unique(beads_.begin(), beads_.end()), beads_.end());
  bead_of_.resize(2 * pieces_.size()), ends_.resize(2 * pieces_.size());
  first_end_.assign(beads_.size() + 1, 0);
  for (std::size_t e = 0; e < bead_of_.size(); ++e) {
    const dem::ParticleId bead = e % 2 == 0 ? first_[e / 2] : second_[e / 2];
    const auto at = std::lower_bound(beads_.begin(), beads_.end(), bead) - beads_.begin();
    bead_of_[e] = static_cast<std::uint32_t>(at);
    ++first_end_[bead_of_[e] + 1];
  }
  for (std::size_t b = 1; b < first_end_.size(); ++b) first_end_[b] += first_end_[b - 1];
  std::vector<std::uint32_t> next(first_end_.begin(), first_end_.end() - 1);
  for (std::size_t e = 0; e < bead_of_.size(); ++e) ends_[next[bead_of_[e]]++] = static_cast<std::uint32_t>(e);
}

void ResolvedWires::find_ends(const dem::Particles& particles, const dem::Bonds& bonds, const Vec3& period,
                              std::vector<WireEnd>& ends) const {
  ends.resize(2 * pieces_.size());
  const auto out_of = [&](std::uint32_t e) {
    return outward(particles, bonds, pieces_[e / 2], static_cast<int>(e % 2));
  };
  for (std::uint32_t e = 0; e < ends.size(); ++e) ends[e] = {out_of(e), 0};
  const auto place_of = [&](std::uint32_t e) { return particles.position[particles.index(beads_[bead_of_[e]])]; };
  std::vector<std::uint32_t> free;
  for (std::size_t b = 0; b < beads_.size(); ++b) {
    const auto here = ends_at(b);
    if (here.size() == 2) join(out_of(here[0]), out_of(here[1]), ends[here[0]], ends[here[1]]);
    if (here.size() == 1) free.push_back(here[0]);
  }
  if ((period.array() <= 0).all()) return;
  for (std::size_t m = 0; m < free.size(); ++m)
    for (std::size_t n = m + 1; n < free.size(); ++n) {
      const std::uint32_t a = free[m], b = free[n];
      const double tolerance = kSamePlace * wire_diameter(particles, bonds, pieces_[a / 2]);
      if (goes_on(place_of(a), place_of(b), period, tolerance)) join(out_of(a), out_of(b), ends[a], ends[b]);
    }
}

}  // namespace lahar::coupling
